// Tests only, a planted fault: E|y|²-|μ|² about the origin, in place of the central moments of
// shaders/moments.glsl, which lies beside it as sound_moments.glsl.
#ifndef NAIVE_MOMENTS_GLSL
#define NAIVE_MOMENTS_GLSL

#define merge sound_merge
#define merge_two sound_merge_two
#include "sound_moments.glsl"
#undef merge
#undef merge_two

Moments merge(Moments a[4], vec4 factor) {
  Moments m = sound_merge(a, factor);
  float total = 0.0, square = 0.0;
  vec3 sum = vec3(0.0);
  for (int k = 0; k < 4; ++k) {
    float w = factor[k] * moments_weight(a[k]);
    total += w;
    sum += w * a[k].mean;
    square += w * (a[k].variance + dot(a[k].mean, a[k].mean));
  }
  if (total <= 0.0) return m;
  m.mean = sum / total;
  m.variance = square / total - dot(m.mean, m.mean);
  return m;
}

Moments merge_two(Moments a, Moments b) {
  Moments m = merge(Moments[4](a, b, empty_moments(), empty_moments()), vec4(1.0, 1.0, 0.0, 0.0));
  Moments sound = sound_merge_two(a, b);
#if LIGHT_LOBES & DIFFUSE_LOBE
  m.diffuse = sound.diffuse;
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  m.specular = sound.specular;
#endif
  return m;
}

#endif
