// Imperfect shadow maps (Ritschel et al. 2008): one octahedral depth map a light, in a frame about the
// light's axis. The paper has paraboloids over hemispheres; a spherical Gaussian light radiates in all
// directions and its map covers them all, that of a VPL the hemisphere above it. Depth is the distance in
// metres as float bits, which order as unsigned integers. The including file declares `uint maps[]`, `vec4
// frames[]` (position, nothing nearer than w is an occluder; axis, w = 1 for all directions, 0 for the
// hemisphere: two for each light) and `uint map_size`; one that reads maps, `float map_tolerance` in metres,
// too.

const uint kIsmEmpty = 0x7F800000u;  // +infinity
const float kIsmReach = 1.0;         // texels, from a point to about the farthest of its texel
const float kIsmMostSlope = 10.0;    // farthest depth of a texel and that of its point, at most
const float kIsmTolerance = 1.03;    // of a receiver's distance and the map's

// Coordinates about `axis`, which is z (Duff et al. 2017).
vec3 ism_local(vec3 axis, vec3 direction) {
  float s = axis.z >= 0.0 ? 1.0 : -1.0;
  float a = -1.0 / (s + axis.z), b = axis.x * axis.y * a;
  vec3 x = vec3(1.0 + s * axis.x * axis.x * a, s * b, -s * axis.x);
  vec3 y = vec3(b, s + axis.y * axis.y * a, -axis.y);
  return vec3(dot(direction, x), dot(direction, y), dot(direction, axis));
}

// Texel of a unit direction; false outside of the map. `axis`: with its w.
bool ism_texel(vec4 axis, vec3 direction, uint size, out uvec2 texel) {
  vec3 v = ism_local(axis.xyz, direction);
  float z = v.z;
  v /= max(abs(v.x) + abs(v.y) + abs(z), 1e-20);
  vec2 p = vec2(v.x + v.y, v.x - v.y);
  if (axis.w > 0.0) {
    p = z >= 0.0 ? v.xy : (1.0 - abs(v.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(v.xy, vec2(0.0)));
  }
  texel = uvec2(clamp((0.5 + 0.5 * p) * float(size), vec2(0.0), vec2(float(size) - 1.0)));
  return axis.w > 0.0 || z > 0.02;
}

#ifdef ISM_WRITE
// Solid angle of the texel about a unit direction.
float ism_texel_solid_angle(vec4 axis, vec3 direction, uint size) {
  vec3 v = abs(ism_local(axis.xyz, direction));
  float norm = v.x + v.y + v.z;
  return (axis.w > 0.0 ? 4.0 : 2.0) * norm * norm * norm / (float(size) * float(size));
}

// What a point at distance `d` in direction w from the light puts into its texel: how far its plane goes
// within one texel of it, or else a surface at a slope would shadow itself.
float ism_depth(float d, vec3 w, vec3 normal, vec4 axis, uint size) {
  float reach = kIsmReach * sqrt(ism_texel_solid_angle(axis, w, size));
  float c = abs(dot(normal, w)), s = sqrt(max(1.0 - c * c, 0.0));
  return d * min(c / max(c - reach * s, 1e-6), kIsmMostSlope);
}
#else
// 0 or 1.
float ism_visible(uint k, vec3 origin, vec3 axis, vec3 position) {
  vec3 d = position - origin;
  float distance = length(d);
  uvec2 texel;
  if (!ism_texel(vec4(axis, frames[2u * k + 1u].w), d / max(distance, 1e-20), map_size, texel)) {
    return distance > 0.0 ? 0.0 : 1.0;
  }
  float nearest = uintBitsToFloat(maps[(k * map_size + texel.y) * map_size + texel.x]);
  return distance <= nearest * kIsmTolerance + map_tolerance ? 1.0 : 0.0;
}
#endif
