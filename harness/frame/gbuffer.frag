// A surface as scene/surface.h defines it, seen from the eye or from the light, by what the scene calls for
// (frame/permutation.h).
#version 460
#include "types.h"
#include "shading_normal.glsl"
#ifndef BASE_COLOR_TEXTURES
#define BASE_COLOR_TEXTURES 1
#endif
#ifndef METALLIC_ROUGHNESS_TEXTURES
#define METALLIC_ROUGHNESS_TEXTURES 1
#endif
#ifndef NORMAL_MAPS
#define NORMAL_MAPS 1
#endif
#ifndef SMOOTH_NORMALS
#define SMOOTH_NORMALS 1
#endif
#ifndef NO_LOBE
#define NO_LOBE 0
#endif
#ifndef ALPHA_MASKS
#define ALPHA_MASKS 1
#endif
layout(set = 0, binding = 0) uniform sampler2D base_color_map;  // sRGB
layout(set = 0, binding = 1) uniform sampler2D metallic_roughness_map;
layout(set = 0, binding = 2) uniform sampler2D normal_map;
layout(set = 0, binding = 3, scalar) uniform View { Emitter viewer; };
layout(set = 0, binding = 4, std430) readonly buffer FaceNormals { vec4 face_normals[]; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 0) out vec4 out_position;
layout(location = 1) out vec4 out_normal;
// The others in the order of field_maps.glsl, which leaves out the same.
#define DIFFUSE_LOCATION (FACE_NORMALS == 1 ? 2 : 3)
#define F0_LOCATION (DIFFUSE_LOCATION + ((SURFACE_LOBES & DIFFUSE_LOBE) != 0 ? 1 : 0))
#if FACE_NORMALS == 0
layout(location = 2) out vec4 out_geometric;
#endif
#if SURFACE_LOBES & DIFFUSE_LOBE
layout(location = DIFFUSE_LOCATION) out vec4 out_diffuse;
#endif
#if SURFACE_LOBES & SPECULAR_LOBE
layout(location = F0_LOCATION) out vec4 out_f0;
#endif
layout(push_constant, scalar) uniform Push { DrawPush draw; };

void main() {
  vec4 color = draw.base_color;
#if BASE_COLOR_TEXTURES || ALPHA_MASKS
  if ((draw.textures & 1u) != 0u) {
    vec4 t = texture(base_color_map, uv);
    color.a *= t.a;
#if BASE_COLOR_TEXTURES
    color.rgb *= t.rgb;
#endif
  }
#endif
#if ALPHA_MASKS
  if (color.a < draw.alpha_cutoff) discard;
#endif
  float metallic = draw.metallic, roughness = draw.roughness;
#if METALLIC_ROUGHNESS_TEXTURES
  if ((draw.textures & 2u) != 0u) {
    vec4 t = texture(metallic_roughness_map, uv);
    roughness *= t.g;
    metallic *= t.b;
  }
#endif
  vec3 view = towards(viewer, position);

  // The face's normal on the viewer's side.
  vec3 geometric = face_normals[draw.first_triangle + uint(gl_PrimitiveID)].xyz;
  if (dot(geometric, view) < 0.0) geometric = -geometric;

#if FACE_NORMALS
  out_normal.xyz = geometric;  // its bend towards the viewer is for who reads it
#else
  // The face's normal on the side of the vertices' own: a normal map is seen from there.
  vec3 n = dot(normal, geometric) < 0.0 ? -geometric : geometric;
#if SMOOTH_NORMALS
  // What differs by no more than the rounding of vertices and of interpolation is the face's own normal, so
  // that where all normals are, no bit differs from the other branch. Opposite normals may cancel.
  vec3 smooth_normal = dot(normal, normal) > 0.0 ? normalize(normal) : n;
  if (distance(smooth_normal, n) > 2e-6) n = smooth_normal;
#endif
#if NORMAL_MAPS
  if ((draw.textures & 4u) != 0u) {
    vec3 axis = tangent.xyz - n * dot(n, tangent.xyz);
    if (dot(axis, axis) > 1e-12) {
      vec3 x = normalize(axis);
      vec3 y = (tangent.w < 0.0 ? -1.0 : 1.0) * cross(n, x);
      vec3 m = 2.0 * texture(normal_map, uv).xyz - 1.0;
      m.xy *= draw.normal_scale;
      n = normalize(m.x * x + m.y * y + m.z * n);
    }
  }
#endif
  if (dot(n, geometric) < 0.0) n = -n;
  out_normal.xyz = bent_normal(n, view);
  out_geometric = vec4(geometric, 0.0);
#endif

  out_position = vec4(position, 1.0);
  float alpha = max(roughness * roughness, 1e-3);
#if PHONG_LOBES
  out_normal.w = draw.phong_exponent > 0.0 ? -draw.phong_exponent : alpha;
#else
  out_normal.w = draw.phong_exponent > 0.0 ? max(sqrt(2.0 / (2.0 + draw.phong_exponent)), 1e-3) : alpha;
#endif
#if NO_LOBE
  out_diffuse = vec4(0.0);
#elif SURFACE_LOBES & DIFFUSE_LOBE
  out_diffuse = vec4(color.rgb * (1.0 - metallic) * (1.0 - 0.04 * draw.specular), 0.0);
#endif
#if SURFACE_LOBES & SPECULAR_LOBE
  out_f0 = vec4(draw.specular * mix(vec3(0.04), color.rgb, metallic), 0.0);
#endif
}
