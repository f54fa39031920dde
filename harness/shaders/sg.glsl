// Spherical Gaussians G(ω;ξ,λ) = exp(λ(ω·ξ-1)) in cancellation-free forms.
// Sources: [MFIS16] App. A–C, [VSGL15s], Xu et al. 2013 (ASG).
#ifndef VSGLBENCH_SG_GLSL
#define VSGLBENCH_SG_GLSL

#include "math.glsl"

struct Sg {
  vec3 axis;        // unit
  float sharpness;  // λ >= 0
};

// (1-e^{-2λ})/λ, so that A(λ) = 2π times this. Relative error < 2e-6 for λ >= 0: below 0.01 by series,
// because 1-e^{-2λ} cancels there.
float sg_integral_over_2pi(float sharpness) {
  float series = 2.0 - sharpness * (2.0 - sharpness * (4.0 / 3.0));
  return sharpness < 0.01 ? series : (1.0 - exp(-2.0 * sharpness)) / sharpness;
}

// A(λ) = ∫G dω = 2π(1-e^{-2λ})/λ [MFIS16 App. A].
float sg_integral(float sharpness) { return 2.0 * PI * sg_integral_over_2pi(sharpness); }

// Product of two SGs: another SG times exp(log_amplitude), with log_amplitude = λ-λ1-λ2 evaluated as
// -λ1λ2|ξ1-ξ2|²/(λ+λ1+λ2) [light-transport §2].
Sg sg_product(vec3 axis1, float sharpness1, vec3 axis2, float sharpness2, out float log_amplitude) {
  vec3 sum = sharpness1 * axis1 + sharpness2 * axis2;
  vec3 difference = axis1 - axis2;
  float sharpness = length(sum);
  float total = sharpness + sharpness1 + sharpness2;
  log_amplitude = total > 0.0 ? -sharpness1 * (sharpness2 / total) * dot(difference, difference) : 0.0;
  return Sg(sharpness > 0.0 ? sum / sharpness : axis1, sharpness);
}

// Toksvig: mean direction length r = λ/(λ+1) is carried as q = 1-r, which keeps its digits for sharp lobes.
float toksvig_complement(float sharpness) { return 1.0 / (sharpness + 1.0); }
// λ = r/(1-r) = (1-q)/q [MFIS16 App. B.1]. q >= 2^-41 bounds λ.
float toksvig_sharpness(float complement) {
  float q = clamp(complement, 4.5474735e-13, 1.0);
  return (1.0 - q) / q;
}

#endif
