#ifndef VSGLBENCH_MATH_GLSL
#define VSGLBENCH_MATH_GLSL

const float PI = 3.14159265358979;

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

// Unit vector, or `fallback` where v has no direction; NaN stays NaN.
vec3 safe_normalize(vec3 v, vec3 fallback) {
  float l2 = dot(v, v);
  return l2 <= 1e-30 ? fallback : v * inversesqrt(l2);
}

#endif
