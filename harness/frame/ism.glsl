// Imperfect shadow maps (Ritschel et al. 2008): one paraboloid depth map a light, over the hemisphere about
// the light's axis. Depth is the distance in metres as float bits, which order as unsigned integers.
// The including file declares `uint maps[]` and `map_size`.

const uint kIsmEmpty = 0x7F800000u;  // +infinity

// An orthonormal frame about `axis` (Duff et al. 2017).
void ism_frame(vec3 axis, out vec3 x, out vec3 y) {
  float s = axis.z >= 0.0 ? 1.0 : -1.0;
  float a = -1.0 / (s + axis.z), b = axis.x * axis.y * a;
  x = vec3(1.0 + s * axis.x * axis.x * a, s * b, -s * axis.x);
  y = vec3(b, s + axis.y * axis.y * a, -axis.y);
}

// Texel of a direction; false behind the hemisphere.
bool ism_texel(vec3 axis, vec3 direction, uint size, out uvec2 texel) {
  vec3 x, y;
  ism_frame(axis, x, y);
  float z = dot(direction, axis);
  vec2 p = vec2(dot(direction, x), dot(direction, y)) / (1.0 + max(z, 0.0));  // within the unit disk
  texel = uvec2(clamp((0.5 + 0.5 * p) * float(size), vec2(0.0), vec2(float(size) - 1.0)));
  return z > 0.02;
}

#ifndef ISM_WRITE
// 0 or 1. A point within 10 % (plus 1 cm) of the stored distance is lit: the maps are that coarse.
float ism_visible(uint k, vec3 origin, vec3 axis, vec3 position) {
  vec3 d = position - origin;
  float distance = length(d);
  uvec2 texel;
  if (!ism_texel(axis, d / max(distance, 1e-20), map_size, texel)) return distance > 0.0 ? 0.0 : 1.0;
  float nearest = uintBitsToFloat(maps[(k * map_size + texel.y) * map_size + texel.x]);
  return distance <= nearest * 1.1 + 0.01 ? 1.0 : 0.0;
}
#endif
