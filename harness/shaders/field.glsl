// Texels of a half (G-buffer or RSM): what the rasteriser wrote, and the leaf moments made from it.
// The including file declares the samplers (field_maps.glsl).
#ifndef VSGLBENCH_FIELD_GLSL
#define VSGLBENCH_FIELD_GLSL

#include "brdf.glsl"
#include "moments.glsl"
#include "shading_normal.glsl"

struct Texel {
  Surface surface;  // .view points towards the emitter
  vec3 flux;        // incident, W
  float footprint;  // world area, m²
};

// False where the emitter sees no surface.
bool load_texel(Emitter e, ivec2 at, out Texel t) {
  vec4 position = texelFetch(position_map, at, 0);
  vec4 normal = texelFetch(normal_map, at, 0);
  t.surface.position = position.xyz;
#if FACE_NORMALS
  t.surface.geometric_normal = normal.xyz;
#else
  t.surface.geometric_normal = texelFetch(geometric_map, at, 0).xyz;
#endif
  t.surface.normal = shading_normal(e, normal.xyz, position.xyz);
#if SURFACE_LOBES & DIFFUSE_LOBE
  t.surface.diffuse = texelFetch(diffuse_map, at, 0).rgb;
#else
  t.surface.diffuse = vec3(0.0);
#endif
#if SURFACE_LOBES & SPECULAR_LOBE
  t.surface.ndf = normal.w;
  t.surface.f0 = texelFetch(f0_map, at, 0).rgb;
#else
  t.surface.ndf = 1.0;
  t.surface.f0 = vec3(0.0);
#endif
  // Texel centre on the emitter's plane, y up.
  vec2 uv = (vec2(at) + 0.5) / vec2(e.width, e.height);
  vec2 plane = vec2(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y) * e.extent;
  float area = 4.0 * e.extent.x * e.extent.y / (float(e.width) * float(e.height));
  float distance2 = 1.0, cos3 = 1.0;
  if (e.perspective != 0u) {
    vec3 to_emitter = e.position - position.xyz;
    distance2 = max(dot(to_emitter, to_emitter), 1e-20);
    t.surface.view = to_emitter * inversesqrt(distance2);
    float cosine = inversesqrt(1.0 + dot(plane, plane));
    cos3 = cosine * cosine * cosine;
  } else {
    t.surface.view = -e.forward;
  }
  // Flux: spot I (2 tan(fov/2)/W)² cos³θ, directional E × texel area [light-transport §1].
  t.flux = e.importance != 0u ? vec3(1.0 / (float(e.width) * float(e.height))) : e.power * (area * cos3);
  float cos_surface = max(dot(t.surface.geometric_normal, t.surface.view), e.footprint_cosine);
  t.footprint = area * cos3 * distance2 / cos_surface;
  return position.w > 0.0;
}

// Lambert's lobe as an SG: sharpness 2 [VSGL15s Eq. A.1]; LAMBERT_LOBE 1: 2.2925, of the author's later code.
#ifndef LAMBERT_LOBE
#define LAMBERT_LOBE 0
#endif
float lambert_sharpness() { return LAMBERT_LOBE == 1 ? 2.2925 : 2.0; }

// Reflected specular power ratio along the mirror direction: ∫C·G/A with C = peak V F n·l gives F·G2 for
// GGX and (n+2)/n F·G2 for Phong [MFIS16 Eq. 7; the paper leaves R_s open].
vec3 specular_reflectance(Surface s) {
  if ((SURFACE_LOBES & SPECULAR_LOBE) == 0) return vec3(0.0);
  float cosine = max(dot(s.normal, s.view), 1e-3);
  float sharpness = ndf_sharpness(s.ndf);
  float g2 = 4.0 * cosine * cosine * smith_visibility(cosine, cosine, masking_alpha(s.ndf));
  return min(fresnel(s.f0, cosine) * (g2 * ndf_peak(s.ndf) * 2.0 * PI / sharpness), vec3(1.0));
}

Moments leaf_moments(Texel t) {
  Surface s = t.surface;
  Moments m;
#if LIGHT_LOBES & DIFFUSE_LOBE
  m.diffuse.power = t.flux * s.diffuse;
  m.diffuse.q = lobe_complement(lambert_sharpness());
  m.diffuse.direction = (1.0 - m.diffuse.q) * s.normal;
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  float cosine = max(dot(s.normal, s.view), 1e-3);
  // Specular lobe: about the mirror direction, λs = λh/(4|ω'·n|) [VSGL15s App. A].
  m.specular.power = t.flux * specular_reflectance(s);
  m.specular.q = lobe_complement(ndf_sharpness(s.ndf) / (4.0 * cosine));
  m.specular.direction = (1.0 - m.specular.q) * reflect(-s.view, s.normal);
#endif
  m.mean = s.position;
  // A texel is a square of area a: its own variance is a/6, so no cluster's is ever below it.
  m.variance = t.footprint / 6.0;
  return m;
}

#endif
