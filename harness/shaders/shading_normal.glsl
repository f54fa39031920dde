// The shading normal of a texel from what the normal map holds, and the bend towards the viewer that the
// rasteriser, the ray tracer and the kernels share (scene/surface.h).
#ifndef VSGLBENCH_SHADING_NORMAL_GLSL
#define VSGLBENCH_SHADING_NORMAL_GLSL

#include "types.h"

// A shading normal that turns away from the viewer is bent back: its cosine with `view` is near 0.01 at
// least.
vec3 bent_normal(vec3 n, vec3 view) {
  float nv = dot(n, view);
  return nv < 0.01 ? normalize(n + (0.01 - nv) * view) : n;
}

// Unit, from `position` towards the emitter. Chosen, not branched to: lavapipe (Mesa 22.3) inlined a branch
// on this uniform into the rasteriser's shader, compiled it anew at every draw, and kept each
// (open_frames_test.cpp).
vec3 towards(Emitter e, vec3 position) {
  return mix(-e.forward, normalize(e.position - position), bvec3(e.perspective != 0u));
}

// `stored`: of normal_map, at a texel of this position.
vec3 shading_normal(Emitter e, vec3 stored, vec3 position) {
#if FACE_NORMALS
  return bent_normal(stored, towards(e, position));
#else
  return stored;
#endif
}

#endif
