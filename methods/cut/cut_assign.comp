// Step 4: the light of each texel, down the tree; `count` where it has no surface, or the PDF chose none.
#version 460
#include "cut.glsl"
#include "shading_normal.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D position_map;  // xyz, w > 0 where there is a surface
layout(set = 0, binding = 1) uniform sampler2D normal_map;
layout(set = 0, binding = 2, scalar) readonly buffer Spaces { Space space; };
layout(set = 0, binding = 3, scalar) readonly buffer Nodes { Node nodes[]; };
layout(set = 0, binding = 4, std430) writeonly buffer Ids { uint ids[]; };
layout(push_constant, scalar) uniform Push {
  Emitter emitter;
  uint count;
  float direction_length;
};

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (at.x >= emitter.width || at.y >= emitter.height) return;
  vec4 p = texelFetch(position_map, at, 0);
  vec3 position = (p.xyz - space.origin) * space.scale;
  vec3 direction = direction_length * shading_normal(emitter, texelFetch(normal_map, at, 0).xyz, p.xyz);
  uint node = 0u, light = 0u, budget = count;
  while (budget > 1u) {
    Node n = nodes[node];
    uint left = node_left(n);
    bool below = along(position, direction, node_axis(n)) < n.threshold;
    node += below ? 1u : left;
    light += below ? 0u : left;
    budget = left == 0u ? 1u : below ? left : budget - left;
  }
  ids[uint(at.y) * emitter.width + uint(at.x)] = p.w > 0.0 && space.valid != 0u ? light : count;
}
