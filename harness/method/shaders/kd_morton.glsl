// Morton codes of centres: 15 bits an axis in 2-D, 10 in 3-D, on a cube round all of them.
#ifndef VSGLBENCH_KD_MORTON_GLSL
#define VSGLBENCH_KD_MORTON_GLSL

const uint AXIS_BITS = DIMENSIONS == 2 ? 15u : 10u;
const uint CODE_BITS = 30u;

// Bit i of v goes to bit DIMENSIONS·i.
uint spread(uint v) {
#if DIMENSIONS == 2
  v = (v | v << 8) & 0x00FF00FFu;
  v = (v | v << 4) & 0x0F0F0F0Fu;
  v = (v | v << 2) & 0x33333333u;
  return (v | v << 1) & 0x55555555u;
#else
  v = (v | v << 16) & 0x030000FFu;
  v = (v | v << 8) & 0x0300F00Fu;
  v = (v | v << 4) & 0x030C30C3u;
  return (v | v << 2) & 0x09249249u;
#endif
}

// Of CODE_BITS bits.
uint morton_code(vec3 position, vec3 low, vec3 high) {
  vec3 extent = high - low;
  float size = max(extent.x, max(extent.y, extent.z));
  vec3 t = size > 0.0 ? (position - low) / size : vec3(0.0);
  uvec3 q = uvec3(clamp(t, 0.0, 1.0) * float((1u << AXIS_BITS) - 1u));
  uint code = spread(q.x) | spread(q.y) << 1;
#if DIMENSIONS == 3
  code |= spread(q.z) << 2;
#endif
  return code;
}

#endif
