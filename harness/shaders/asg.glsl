// Anisotropic spherical Gaussians max(ω·z,0) exp(-ηx(ω·x)² - ηy(ω·y)²) (Xu et al. 2013), by the components of
// a direction in the frame (x,y,z). An SG of sharpness λ is one of bandwidths λ/2.
#ifndef VSGLBENCH_ASG_GLSL
#define VSGLBENCH_ASG_GLSL

#include "math.glsl"
#include "special.glsl"

// Error < 1e-6 (1+x), x the exponent, with the device's own exp.
float asg_value(vec3 local, float eta_x, float eta_y) {
  return max(local.z, 0.0) * exp(-eta_x * local.x * local.x - eta_y * local.y * local.y);
}

// ∫ SG × ASG ≈ π/√((ηx+ν)(ηy+ν)) Ĝ(ξ; ηxν/(ηx+ν), ηyν/(ηy+ν)), ν = λ/2 [VSGL15s App. B], for ηx, ηy > 0 and
// λ >= 0, all below 2^60. Error < 2e-6 (1+x), x the exponent: for a lobe axis that is itself a rounded dot
// product, as a pixel's is, more digits would mean nothing.
float asg_product(vec3 local_axis, float sharpness, float eta_x, float eta_y) {
  float nu = 0.5 * sharpness;
  float sum_x = eta_x + nu, sum_y = eta_y + nu;
  float lobe = asg_value(local_axis, (eta_x / sum_x) * nu, (eta_y / sum_y) * nu);
  return lobe * PI * inversesqrt(sum_x * sum_y);
}

// ην/(η+ν) w² as a sum of two floats.
vec2 asg_exponent(float eta, float nu, float w) {
  float sum_low, back_low, w2_low, m_low, x_low;
  float sum = two_sum(eta, nu, sum_low);
  precise float ratio = eta / sum;
  float back = two_product(ratio, sum, back_low);
  precise float ratio_low = ((eta - back) - back_low - ratio * sum_low) / sum;
  float w2 = two_product(w, w, w2_low);
  float m = two_product(nu, ratio, m_low);
  float x = two_product(m, w2, x_low);
  precise float low = x_low + (m * w2_low + (m_low + nu * ratio_low) * w2);
  return vec2(x, low);
}

// The same with its exponent in twice the precision: error < 2e-6 whatever the exponent is.
float asg_product_compensated(vec3 local_axis, float sharpness, float eta_x, float eta_y) {
  float nu = 0.5 * sharpness;
  vec2 x = asg_exponent(eta_x, nu, local_axis.x), y = asg_exponent(eta_y, nu, local_axis.y);
  float rest;
  float exponent = two_sum(x.x, y.x, rest);
  float lobe = exp_accurate(-exponent) * (1.0 - (rest + x.y + y.y)) * max(local_axis.z, 0.0);
  return lobe * PI / sqrt((eta_x + nu) * (eta_y + nu));
}

#endif
