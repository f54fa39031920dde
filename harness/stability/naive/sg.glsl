// Tests only, a planted fault: the textbook form of the product's amplitude, λ-λ1-λ2, in place of that of
// shaders/sg.glsl, which lies beside it as sound_sg.glsl.
#ifndef NAIVE_SG_GLSL
#define NAIVE_SG_GLSL

#define sg_product sound_sg_product
#include "sound_sg.glsl"
#undef sg_product

Sg sg_product(vec3 axis1, float sharpness1, vec3 axis2, float sharpness2, out float log_amplitude) {
  vec3 sum = sharpness1 * axis1 + sharpness2 * axis2;
  float sharpness = length(sum);
  log_amplitude = sharpness - sharpness1 - sharpness2;
  return Sg(sum / sharpness, sharpness);
}

#endif
