#include "reference/brdf.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "image/image.h"

namespace vsglbench {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

float square(float x) { return x * x; }

// log(1 - x) for x in [0, 1): the series where it is short.
float log_one_minus(float x) {
  if (x < 0.01f) return -x * (1 + x * (0.5f + x * (1.0f / 3 + x * 0.25f)));
  return x < 1 ? std::log1p(-x) : -std::numeric_limits<float>::infinity();
}

// 1 - exp(-x) for x >= 0, likewise.
float one_minus_exp(float x) {
  if (x < 0.05f) return x * (1 - x * (0.5f - x * (1.0f / 6 - x * (1.0f / 24))));
  return -std::expm1(-x);
}

// (1 - c)^5
float schlick_weight(float c) {
  const float m = std::clamp(1 - c, 0.0f, 1.0f);
  return square(square(m)) * m;
}

}  // namespace

void tangent_frame(const glm::vec3& n, glm::vec3* x, glm::vec3* y) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1 / (sign + n.z), b = n.x * n.y * a;
  *x = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  *y = {b, sign + n.y * n.y * a, -n.y};
}

Brdf::Brdf(const Surface& surface, const glm::vec3& to_viewer)
    : n_(surface.normal),
      g_(surface.geometric_normal),
      v_(to_viewer),
      lambert_(surface.diffuse / kPi),
      f0_(surface.f0),
      ndf_(surface.ndf),
      nv_(glm::dot(surface.normal, to_viewer)) {
  f90_ = std::min(1.0f, 50 * std::max(f0_.x, std::max(f0_.y, f0_.z)));
  if (ndf_ > 0) {
    alpha2_ = square(ndf_);
    normalization_ = alpha2_ / kPi;
  } else {
    const float exponent = -ndf_;
    alpha2_ = 2 / (exponent + 2);
    normalization_ = (exponent + 2) / (2 * kPi);
  }
  smith_v_ = std::sqrt(nv_ * nv_ * (1 - alpha2_) + alpha2_);

  // Choose between the lobes by what each reflects: Rd, and F towards the viewer. Beside a sharp lobe Lambert
  // counts for a fifth: other strategies find what it reflects, none what the sharp lobe does.
  const float diffuse = luminance(surface.diffuse) * (is_sharp() ? 0.2f : 1.0f);
  const float specular = f90_ > 0 ? luminance(glm::mix(f0_, glm::vec3(f90_), schlick_weight(nv_))) : 0;
  diffuse_probability_ = specular > 0 ? diffuse / (diffuse + specular) : 1;
}

inline float Brdf::ndf(float nh, float sin2) const {
  // (n.h)^2 (a^2 - 1) + 1 = a^2 (n.h)^2 + |n x h|^2
  if (ndf_ > 0) return normalization_ / square(alpha2_ * nh * nh + sin2);
  // (n.h)^e = exp(e/2 log(1 - |n x h|^2)), and log(1 - x) <= -x.
  const float half_exponent = -0.5f * ndf_;
  if (half_exponent * sin2 > 87) return 0;  // below fp32's least normal number
  return normalization_ * std::exp(half_exponent * log_one_minus(sin2));
}

inline Brdf::Half Brdf::half_vector(const glm::vec3& l) const {
  const glm::vec3 sum = l + v_;
  const float length2 = glm::dot(sum, sum);
  if (!(length2 > 1e-12f)) return {};
  const glm::vec3 h = sum / std::sqrt(length2);
  Half half;
  half.nh = glm::dot(n_, h);
  half.vh = glm::dot(v_, h);
  const glm::vec3 cross = glm::cross(n_, h);
  if (half.nh > 0) half.d = ndf(half.nh, glm::dot(cross, cross));
  return half;
}

inline float Brdf::microfacet_pdf(const Half& half) const {
  return half.d > 0 && half.vh > 0 ? half.d * half.nh / (4 * half.vh) : 0;
}

void Brdf::add_microfacet(const glm::vec3& l, float nl, BrdfValue* value) const {
  const Half half = half_vector(l);
  if (!(half.d > 0)) return;
  const float smith_l = std::sqrt(nl * nl * (1 - alpha2_) + alpha2_);
  const float visibility = 0.5f / (nl * smith_v_ + nv_ * smith_l);
  const glm::vec3 fresnel = f0_ + (f90_ - f0_) * schlick_weight(half.vh);
  value->f += half.d * visibility * fresnel;
  value->pdf += (1 - diffuse_probability_) * microfacet_pdf(half);
}

float Brdf::pdf(const glm::vec3& l) const {
  const float diffuse = diffuse_probability_ * std::max(glm::dot(n_, l), 0.0f) / kPi;
  if (diffuse_probability_ >= 1) return diffuse;
  return diffuse + (1 - diffuse_probability_) * microfacet_pdf(half_vector(l));
}

bool Brdf::sample(const glm::vec3& random, glm::vec3* direction) const {
  const float angle = 2 * kPi * random.y, u = random.x;
  glm::vec3 x, y;
  tangent_frame(n_, &x, &y);
  const glm::vec3 around = std::cos(angle) * x + std::sin(angle) * y;

  // Cosine-weighted hemisphere.
  if (random.z < diffuse_probability_) {
    *direction = std::sqrt(u) * around + std::sqrt(1 - u) * n_;
    return true;
  }

  // Half vector with density D(h) n.h: sin^2 from u without 1 - cos^2.
  const float sin2 = ndf_ > 0 ? alpha2_ * u / (1 - u + alpha2_ * u)         // tan^2 = a^2 u / (1 - u)
                              : one_minus_exp(-std::log(1 - u) * alpha2_);  // cos = (1 - u)^(1/(e+2))
  const glm::vec3 h = std::sqrt(sin2) * around + std::sqrt(std::max(0.0f, 1 - sin2)) * n_;
  const float vh = glm::dot(v_, h);
  *direction = glm::normalize(2 * vh * h - v_);
  return vh > 0;
}

}  // namespace vsglbench
