// Functions that GLSL lacks, or has with too wide a bound: Vulkan allows exp(x) an error of 3+2|x| ulp, and
// log(x) an absolute one of 2^-21 near 1 (so Higham's (u-1)/log(u) for expm1(x)/x loses all digits there).
// Only +, -, * (correctly rounded), / (2.5 ulp) and conversions of a device are relied upon here.
// Bounds are relative, in single precision, unless they say "absolute"; sg_evaluation_test.cpp measures them.
//
// `precise` keeps an operation as written: not fused, not regrouped. Drivers do simplify (a+b)-a to b.
#ifndef VSGLBENCH_SPECIAL_GLSL
#define VSGLBENCH_SPECIAL_GLSL

// a+b = sum + error, exactly (Knuth 1969).
float two_sum(float a, float b, out float error) {
  precise float sum = a + b;  // precise: the error term is zero in exact arithmetic
  precise float part = sum - a;
  precise float rest = (a - (sum - part)) + (b - part);
  error = rest;
  return sum;
}

// a*b = product + error, exactly (Veltkamp 1968, Dekker 1971), for |a|, |b| < 2^114 and a product whose error
// term is no denormal. Not by fma(): a device may compute that in two roundings.
float two_product(float a, float b, out float error) {
  precise float product = a * b;  // precise: as in two_sum
  precise float a_big = 4097.0 * a, b_big = 4097.0 * b;
  precise float a_high = a_big - (a_big - a), b_high = b_big - (b_big - b);
  precise float a_low = a - a_high, b_low = b - b_high;
  precise float rest = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
  error = rest;
  return product;
}

// e^x = scale (1 + result): x = k ln 2 + r with |r| <= ln(2)/2, scale = 2^k, and e^r-1 = r + r² P(r) with P a
// Chebyshev fit of error 1.5e-9. For x in [-87,88].
float expm1_reduced(float x, out float scale) {
  float k = floor(x * 1.44269504 + 0.5);
  // ln 2 in two parts, of which k times the first is exact; precise: so that it stays two parts.
  precise float r = (x - k * 0.693359375) + k * 2.12194440e-4;
  scale = uintBitsToFloat(uint(int(k) + 127) << 23);
  float p = 1.393382049e-3 + r * 1.989118016e-4;
  p = 0.4999999999 + r * (0.1666666668 + r * (0.04166646339 + r * (0.008333310755 + r * p)));
  return r + r * r * p;
}

// e^x, error < 2e-7 for x in [-87.3,88]; 0 below.
float exp_accurate(float x) {
  float scale;
  float part = expm1_reduced(clamp(x, -87.3, 88.0), scale);
  return x < -87.3 ? 0.0 : scale + scale * part;
}

// e^x - 1, error < 3e-7 for x <= 88.
float expm1(float x) {
  float scale;
  float part = expm1_reduced(clamp(x, -87.0, 88.0), scale);
  return (scale - 1.0) + scale * part;  // scale-1 is exact where it matters
}

// E(x) = (e^x-1)/x, 1 at 0; error < 4e-7 for x <= 88.
float expm1_over_x(float x) { return x == 0.0 ? 1.0 : expm1(x) / x; }

// tanh(x), error < 5e-7.
float tanh_accurate(float x) {
  float m = expm1(-2.0 * abs(x));
  return sign(x) * (-m / (2.0 + m));
}

// erf(x)/x for |x| <= 1, as a polynomial in x² (Chebyshev fit, error 1.3e-9).
float erf_over_x(float x2) {
  float p = 5.189087423e-3 + x2 * (-8.016864287e-4 + x2 * 7.875875063e-5);
  return 1.128379166 + x2 * (-0.3761262667 + x2 * (0.1128359472 + x2 * (-0.02685421201 + x2 * p)));
}

// erfc(x) for x >= 1: t e^{-x²} P(t) with t = 1/(1+x/2) (Chebyshev fit of error 1e-8).
float erfc_tail(float x) {
  float t = 1.0 / (1.0 + 0.5 * x);
  float p = -0.446049913 + t * (0.248894593 + t * -0.04682952932);
  p = 0.2030689397 + t * (-0.02126175449 + t * (0.2551401491 + t * p));
  p = 0.2820806781 + t * (0.2824661356 + t * (0.2426307528 + t * p));
  return t * exp_accurate(-x * x) * p;
}

// erf(x), error < 4e-7.
float erf(float x) {
  float a = abs(x);
  return a < 1.0 ? x * erf_over_x(x * x) : sign(x) * (1.0 - erfc_tail(a));
}

// erfc(x), error < 1e-6 + 2^-24 x² (the rounding of x² under the exponential); 0 past 9.34.
float erfc(float x) {
  float a = abs(x);
  if (a < 1.0) return 1.0 - x * erf_over_x(x * x);
  float tail = erfc_tail(a);
  return x > 0.0 ? tail : 2.0 - tail;
}

#endif
