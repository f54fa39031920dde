// The deferred rasteriser of both halves: camera (G-buffer) and primary light (RSM).
#version 460
#include "types.h"
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec2 in_uv;
layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 tangent;
layout(location = 3) out vec2 uv;
layout(push_constant, scalar) uniform Push { DrawPush draw; };

void main() {
  position = in_position;
  normal = in_normal;
  tangent = in_tangent;
  uv = in_uv;
  gl_Position = draw.view_projection * vec4(in_position, 1.0);
}
