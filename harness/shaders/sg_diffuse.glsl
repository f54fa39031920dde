// The clamped cosine against a normalised SG: L(v,κ) = ∫G max(ω·n,0) dω / ∫G dω, by one of five formulas.
// DIFFUSE_MODEL: 0 cosine, 1 pettineo-hill, 2 meder-bruederlin, 3 tokuyoshi2022, 4 tokuyoshi2024.
// Largest absolute errors against the integral stand with each; L is in [0,1], and so is every formula's
// value here but pettineo-hill's.
#ifndef VSGLBENCH_SG_DIFFUSE_GLSL
#define VSGLBENCH_SG_DIFFUSE_GLSL

#include "special.glsl"

#ifndef DIFFUSE_MODEL
#define DIFFUSE_MODEL 0
#endif

// The cosine pulled out of the integral [VSGL15s App. B]: right for κ → ∞, by 0.05 at κ = 64, 0.75 at 0.
float cosine_pulled_out(float cosine) { return max(cosine, 0.0); }

// Pettineo and Hill 2016, "SG Series Part 3"; their irradiance over A(λ). Within 0.02 for κ >= 1; diverges to
// -∞ as κ → 0, unlike L, so κ is taken as 1e-6 at least.
float pettineo_hill(float cosine, float sharpness) {
  const float c0 = 0.36, c1 = 1.0 / (4.0 * 0.36);
  float k = max(sharpness, 1e-6);
  float e1 = exp_accurate(-k), e2 = exp_accurate(-2.0 * k);
  float complement = 1.0 / k - 2.0 * e2;  // 1-s
  float bias = e1 * expm1_over_x(-k) - e2;
  float x = sqrt(complement), x0 = c0 * cosine, x1 = c1 * x;
  float y = abs(x0) <= x1 ? (x0 + x1) * (x0 + x1) / x : clamp(cosine, 0.0, 1.0);
  return ((1.0 - complement) * y + bias) / -expm1(-2.0 * k);
}

// σ = 2s-1 of the normalised hemispherical integral s(v·n,κ) [SGL22 §3]; odd in the cosine, ±1 at ±1.
// Meder and Brüderlin 2018: a logistic function, whose σ is tanh(tc/2)/tanh(t/2). Within 0.012 in s.
float logistic_sigma(float cosine, float k) {
  float t = sqrt(k) * k * (1.6988 * k + 10.8438) / (k * (k + 6.2201) + 10.2415);
  return t > 0.0 ? clamp(tanh_accurate(0.5 * t * cosine) / tanh_accurate(0.5 * t), -1.0, 1.0) : cosine;
}

// [SGL22 Eq. 1]. Within 0.005 in s.
float gaussian_sigma(float cosine, float k) {
  float t = k * sqrt((0.5 * k + 0.651732883) / (k * (k + 1.3418280) + 7.22166878));
  return t > 0.0 ? clamp(erf(t * cosine) / erf(t), -1.0, 1.0) : cosine;
}

#if DIFFUSE_MODEL == 2
#define HEMISPHERE_SIGMA logistic_sigma
#else
#define HEMISPHERE_SIGMA gaussian_sigma
#endif

// s(v·n,κ); absolute error < 5e-7 against the same formula in double precision.
float normalized_hemisphere(float cosine, float sharpness) {
  return 0.5 + 0.5 * HEMISPHERE_SIGMA(cosine, sharpness);
}

// E'(x) = (e^x-E(x))/x for x <= 0; by series near 0.
float expm1_over_x_derivative(float x) {
  float series = 0.5 + x * (1.0 / 3.0 + x * (1.0 / 8.0 + x * (1.0 / 30.0 + x / 144.0)));
  return x > -0.05 ? series : (exp_accurate(x) - expm1_over_x(x)) / x;
}

// The clamped cosine as (α+β) e^λ G(ω;n,λ) - α on the upper hemisphere [SGL22 §2]: α(p-q) + βp, where p and q
// are the hemispherical integrals of the two SGs times the vMF lobe. With λ' and c' of the SG product, d =
// λ'-κ, R = A(λ')/A(κ), and W = ½ + ½ σ tanh(κ/2) the share of the hemisphere,
//   p = e^d R W',  q = W,  p-q = (e^d-1) R W' + (R-1) W' + (W'-W),
// of which no part but the last (a difference of two values of ½ at most) cancels: α = 1182 would turn the
// rounding of p and q into an error of 2e-4 and more.
float sg_cosine(float cosine, float k, float lambda, float alpha, float beta) {
  float sharpness = sqrt((k - lambda) * (k - lambda) + 2.0 * k * lambda * (1.0 + cosine));
  float d = lambda * (2.0 * k * cosine + lambda) / (sharpness + k);
  float product_cosine = sharpness > 0.0 ? clamp((k * cosine + lambda) / sharpness, -1.0, 1.0) : cosine;
  // R-1; for a small λ by the derivative half way, which is off by no more than λ³/12.
  float integral = expm1_over_x(-2.0 * k);
  float growth = lambda > 0.01 ? expm1_over_x(-2.0 * sharpness) / integral - 1.0
                               : -2.0 * d * expm1_over_x_derivative(-(k + sharpness)) / integral;
  float product_part = HEMISPHERE_SIGMA(product_cosine, sharpness) * tanh_accurate(0.5 * sharpness);
  float part = HEMISPHERE_SIGMA(cosine, k) * tanh_accurate(0.5 * k);
  float share = 0.5 + 0.5 * product_part;
  float step = expm1(d);
  precise float difference = step * (1.0 + growth) * share + growth * share + 0.5 * (product_part - part);
  return clamp(alpha * difference + beta * (1.0 + step) * (1.0 + growth) * share, 0.0, 1.0);
}

// Meder and Brüderlin 2018: μ = 32.7080, α = 31.7003, λ = 0.0315; β = μe^{-λ} - α. Within 0.011; unlike
// theirs clamped (they reach 1.008, and -0.0034).
float meder_bruederlin(float cosine, float sharpness) {
  return sg_cosine(cosine, sharpness, 0.0315, 31.7003, -0.0065437963);
}

// [SGL22 §2]: λ = 0.000845608722, α = λ/(2e^λ-2-2λ) (the paper's E(λ) prints 2e^λ-2-λ). Within 0.0038; its
// own value exceeds 1 by 1.4e-4 for v = n and κ → ∞, and is clamped.
float tokuyoshi2022(float cosine, float sharpness) {
  return sg_cosine(cosine, sharpness, 0.00084560872241480124, 1182.2467339678153, 0.0);
}

// Tokuyoshi et al. 2024, "Hierarchical Light Sampling with Accurate Spherical Gaussian Lighting",
// supplemental: between the integrals over the upper and lower hemisphere for v = n, by that of a planar
// Gaussian. Within 0.0013, and 1.3e-6 for κ >= 1024. Both integrals are over ∫G from the start, which spares
// a division by κ and its error; and erfc is accurate, so f needs no least value.
float tokuyoshi2024(float cosine, float k) {
  float t = k * sqrt(0.5 * ((k + 2.73608316) * k + 17.0212978) /
                     (((k + 4.01008267) * k + 15.2191563) * k + 76.0878963));
  float tc = t * cosine;
  // f: t²(c²-1) = -t²(1-c)(1+c), and expm1(x)/t = t E(x) (c²-1).
  float sine2 = (1.0 - cosine) * (1.0 + cosine);
  float rim = t * sine2 * exp_accurate(-tc * tc) * expm1_over_x(-t * t * sine2) * 0.282094792;  // 1/(2√π)
  float f = clamp(0.5 * (cosine * erfc(-tc) + erfc(t)) + rim, 0.0, 1.0);
  // e^{-κ}-1 = m: E(-κ) = -m/κ, e^{-κ} = 1+m, and of both hemispheres 1-e^{-2κ} = -m(2+m).
  float m = expm1(-k), e = 1.0 + m, upper, lower;
  if (k < 0.5) {
    // Taylor series of (1-E(-κ))/κ and (E(-κ)-e^{-κ})/κ, errors 1e-8.
    float over = 0.5 / expm1_over_x(-2.0 * k);
    upper =
        over *
        (1.0 / 2.0 -
         k * (1.0 / 6.0 -
              k * (1.0 / 24.0 - k * (1.0 / 120.0 - k * (1.0 / 720.0 - k * (1.0 / 5040.0 - k / 40320.0))))));
    lower = over * e *
            (1.0 / 2.0 -
             k * (1.0 / 3.0 -
                  k * (1.0 / 8.0 - k * (1.0 / 30.0 - k * (1.0 / 144.0 - k * (1.0 / 840.0 - k / 5760.0))))));
  } else {
    float whole = -m * (2.0 + m), mean = -m / k;
    upper = (1.0 - mean) / whole;
    lower = e * (mean - e) / whole;
  }
  return lower + f * (upper - lower);
}

// L(v,κ), cosine = v·n, for κ >= 0. Past 2^41, where every formula is at its limit, κ is 2^41: no power of it
// overflows.
float sg_clamped_cosine(float cosine, float sharpness) {
  float c = clamp(cosine, -1.0, 1.0), k = min(sharpness, 2199023255552.0);
#if DIFFUSE_MODEL == 1
  return pettineo_hill(c, k);
#elif DIFFUSE_MODEL == 2
  return meder_bruederlin(c, k);
#elif DIFFUSE_MODEL == 3
  return tokuyoshi2022(c, k);
#elif DIFFUSE_MODEL == 4
  return tokuyoshi2024(c, k);
#else
  return cosine_pulled_out(c);
#endif
}

#endif
