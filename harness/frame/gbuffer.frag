// A surface as scene/surface.h defines it, seen from the eye or from the light.
#version 460
#include "types.h"
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
layout(location = 2) out vec4 out_geometric;
layout(location = 3) out vec4 out_diffuse;
layout(location = 4) out vec4 out_f0;
layout(push_constant, scalar) uniform Push { DrawPush draw; };

void main() {
  vec4 color = draw.base_color;
  if ((draw.textures & 1u) != 0u) color *= texture(base_color_map, uv);
  if (color.a < draw.alpha_cutoff) discard;
  float metallic = draw.metallic, roughness = draw.roughness;
  if ((draw.textures & 2u) != 0u) {
    vec4 t = texture(metallic_roughness_map, uv);
    roughness *= t.g;
    metallic *= t.b;
  }
  // Chosen, not branched to: lavapipe (Mesa 22.3) inlined a branch on this uniform into the shader, compiled
  // it anew at every draw, and kept each (open_frames_test.cpp).
  vec3 towards = normalize(viewer.position - position);
  vec3 view = mix(-viewer.forward, towards, bvec3(viewer.perspective != 0u));

  // The face's normal on the viewer's side.
  vec3 geometric = face_normals[draw.first_triangle + uint(gl_PrimitiveID)].xyz;
  if (dot(geometric, view) < 0.0) geometric = -geometric;

  vec3 n = dot(normal, normal) > 0.0 ? normalize(normal) : geometric;  // opposite normals may cancel
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
  if (dot(n, geometric) < 0.0) n = -n;
  // A shading normal that turns away from the viewer is bent back.
  float nv = dot(n, view);
  if (nv < 0.01) n = normalize(n + (0.01 - nv) * view);

  vec3 f0 = draw.specular * mix(vec3(0.04), color.rgb, metallic);
  out_position = vec4(position, 1.0);
  out_normal = vec4(n, draw.phong_exponent > 0.0 ? -draw.phong_exponent : max(roughness * roughness, 1e-3));
  out_geometric = vec4(geometric, 0.0);
  out_diffuse = vec4(color.rgb * (1.0 - metallic) * (1.0 - 0.04 * draw.specular), 0.0);
  out_f0 = vec4(f0, 0.0);
}
