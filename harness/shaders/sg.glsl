// Spherical Gaussians G(ω;ξ,λ) = exp(λ(ω·ξ-1)) in cancellation-free forms. λ in [0,2^41] unless said
// otherwise. Error bounds are relative, in single precision, against the same formula in double precision on
// the same inputs; harness/operation/sg_evaluation_test.cpp holds them, and shows that the naive forms break
// them. Sources: [MFIS16] App. A–C, [VSGL15s], Banerjee et al. 2005 (vMF), Toksvig 2005.
#ifndef VSGLBENCH_SG_GLSL
#define VSGLBENCH_SG_GLSL

#include "math.glsl"
#include "special.glsl"

// How a mean direction's length becomes a sharpness: 0 toksvig, 1 banerjee.
#ifndef LOBE_CONVERSION
#define LOBE_CONVERSION 0
#endif

struct Sg {
  vec3 axis;        // unit
  float sharpness;  // λ >= 0
};

// G(ω;ξ,λ) as exp(-λ/2 |ω-ξ|²): λ(ω·ξ-1) has no digits left from λ = 1e6 on. Error < 5e-7 (1+x), x the
// exponent; absolute error < 4e-7.
float sg_value(vec3 direction, Sg sg) {
  vec3 d = direction - sg.axis;
  return exp_accurate(-0.5 * sg.sharpness * dot(d, d));
}

// (1-e^{-2λ})/λ, so that A(λ) = 2π times this. Error < 7e-7 for λ >= 0, with the device's own exp: below λ =
// ½, where the difference would cancel, by a Chebyshev fit of (1-e^{-y})/y.
float sg_integral_over_2pi(float sharpness) {
  float y = 2.0 * sharpness;
  float fit = 0.008275504844 + y * (-0.001300774958 + y * 0.0001290763102);
  fit = 0.9999999979 + y * (-0.4999997973 + y * (0.1666634031 + y * (-0.04164684931 + y * fit)));
  return y < 1.0 ? 2.0 * fit : (1.0 - exp(-y)) / sharpness;
}

// A(λ) = ∫G dω = 2π(1-e^{-2λ})/λ, 4π at 0 [MFIS16 App. A]. Error < 7e-7.
float sg_integral(float sharpness) { return 2.0 * PI * sg_integral_over_2pi(sharpness); }

// The factor of the von Mises–Fisher density G/A(κ). Error < 1e-6.
float vmf_normalization(float sharpness) { return 1.0 / sg_integral(sharpness); }

// Product of two SGs: another SG times exp(log_amplitude), with log_amplitude = λ-λ1-λ2 evaluated as
// -λ1λ2|ξ1-ξ2|²/(λ+λ1+λ2) [light-transport §2]: error < 1e-6. λ1, λ2 in [0,2^60], so that no square
// overflows. Where ξ1 = -ξ2 and λ1 = λ2 nothing is left, and the axis is ξ1. The product's own sharpness has
// an error < 4e-7 (λ1+λ2)/λ.
Sg sg_product(vec3 axis1, float sharpness1, vec3 axis2, float sharpness2, out float log_amplitude) {
  vec3 sum = sharpness1 * axis1 + sharpness2 * axis2;
  vec3 difference = axis1 - axis2;
  float sharpness = length(sum);
  float total = sharpness + sharpness1 + sharpness2;
  log_amplitude = total > 0.0 ? -sharpness1 * (sharpness2 / total) * dot(difference, difference) : 0.0;
  return Sg(sharpness > 0.0 ? sum / sharpness : axis1, sharpness);
}

// Toksvig: mean direction length r = λ/(λ+1) is carried as q = 1-r, which keeps its digits for sharp lobes.
// Error < 2e-7.
float toksvig_complement(float sharpness) { return 1.0 / (sharpness + 1.0); }
// λ = r/(1-r) = (1-q)/q [MFIS16 App. B.1]. q >= 2^-41 bounds λ. Absolute error < 4e-7 (1+λ): a wide lobe's λ
// is as good as q says.
float toksvig_sharpness(float complement) {
  float q = clamp(complement, 4.5474735e-13, 1.0);
  return (1.0 - q) / q;
}

// The vMF lobe of mean direction length r: κ ≈ r(3-r²)/(1-r²) [Banerjee et al. 2005, Eq. 4.4], in q = 1-r:
// 1-r² = q(2-q), 3-r² = 2+q(2-q). Absolute error < 4e-7 (1+κ); bounded as toksvig_sharpness is.
float banerjee_sharpness(float complement) {
  float q = clamp(complement, 4.5474735e-13, 1.0);
  float squares = q * (2.0 - q);
  return (1.0 - q) * (2.0 + squares) / squares;
}

// 1-r of the vMF lobe of concentration κ, r = coth κ - 1/κ [Banerjee et al. 2005]. Error < 5e-7 for κ >= 0.
float vmf_complement(float sharpness) {
  float k2 = sharpness * sharpness;
  float series =
      1.0 / 3.0 -
      k2 * (1.0 / 45.0 -
            k2 * (2.0 / 945.0 -
                  k2 * (1.0 / 4725.0 - k2 * (2.0 / 93555.0 - k2 * (2.164404e-6 - k2 * 2.192595e-7)))));
  if (sharpness < 1.0) return 1.0 - sharpness * series;
  return 1.0 / sharpness + 2.0 * exp_accurate(-2.0 * sharpness) / expm1(-2.0 * sharpness);
}

// Inverse of banerjee_sharpness: the root q in (0,1] of (1-q)(2+q(2-q)) = κ q(2-q), by Newton's method from
// the vMF lobe's own 1-r, which is within 5 % of it. Error < 1e-6 for κ in [0,2^41].
float banerjee_complement(float sharpness) {
  float q = vmf_complement(sharpness);
  for (int i = 0; i < 3; ++i) {
    float squares = q * (2.0 - q);
    float value = (1.0 - q) * (2.0 + squares) - sharpness * squares;
    float slope = 3.0 * squares + 2.0 * sharpness * (1.0 - q);  // minus the derivative
    q = clamp(slope > 0.0 ? q + value / slope : q, 0.5 * q, 1.0);
  }
  return q;
}

// 1-r of a texel's lobe, by LOBE_CONVERSION: a lone texel comes back with its own sharpness.
float lobe_complement(float sharpness) {
#if LOBE_CONVERSION == 1
  return banerjee_complement(sharpness);
#else
  return toksvig_complement(sharpness);
#endif
}

// Sharpness of a light's lobe from the length of its mean direction, by LOBE_CONVERSION.
float lobe_sharpness(float complement) {
#if LOBE_CONVERSION == 1
  return banerjee_sharpness(complement);
#else
  return toksvig_sharpness(complement);
#endif
}

#endif
