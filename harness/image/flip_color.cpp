// Sources: Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images", §4.1 and Tab. 1;
// Andersson et al. 2021, "Visualizing Errors in Rendered High Dynamic Range Images", §3; IEC 61966-2-1 (sRGB,
// D65).
#include "image/flip_color.h"

#include <cmath>

namespace vsglbench {
namespace {

// (a x² + b x) / (c x² + d x + e), each x of the fit being 0.6 of ours.
constexpr double kA = 0.36 * 2.51, kB = 0.6 * 0.03, kC = 0.36 * 2.43, kD = 0.6 * 0.59, kE = 0.14;
constexpr float kBrightest = 1e4f;  // the curve is at 1 from 12 on; its squares stay finite

constexpr float kColorPower = 0.7f, kKnee = 0.4f, kKneeError = 0.95f;

// Rows X, Y, Z over the white, from the primaries and white of sRGB; their rows add up to 1.
const glm::dmat3 kToXyz = glm::transpose(glm::dmat3(10135552.0 / 24577794, 8788810.0 / 24577794,  //
                                                    4435075.0 / 24577794,                         //
                                                    2613072.0 / 12288897, 8788810.0 / 12288897,   //
                                                    887015.0 / 12288897,                          //
                                                    1425312.0 / 73733382, 8788810.0 / 73733382,   //
                                                    70074185.0 / 73733382));

glm::mat3 over_white() {
  const glm::dvec3 white = kToXyz * glm::dvec3(1);
  glm::dmat3 m = kToXyz;
  for (int column = 0; column < 3; ++column) m[column] /= white;
  return glm::mat3(m);
}

const glm::mat3 kToRelativeXyz = over_white(), kFromRelativeXyz = glm::inverse(glm::dmat3(over_white()));

float lab_curve(float t) {
  constexpr float delta = 6.0f / 29;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0f / 29;
}

float hyab(const glm::vec3& p, const glm::vec3& q) {
  const glm::vec3 d = p - q;
  return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

float largest_distance() {
  return std::pow(hyab(to_hunt_lab({0, 1, 0}), to_hunt_lab({0, 0, 1})), kColorPower);
}

}  // namespace

float aces(float x) {
  x = x < kBrightest ? x : kBrightest;
  const float y = (float(kA) * x * x + float(kB) * x) / (float(kC) * x * x + float(kD) * x + float(kE));
  return y < 1 ? y : 1;
}

double aces_inverse(double t) {
  const double a = kA - t * kC, b = kB - t * kD, c = -t * kE;
  return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

glm::vec3 to_opponent(const glm::vec3& linear) {
  const glm::vec3 xyz = kToRelativeXyz * linear;
  return {xyz.y, xyz.x - xyz.y, xyz.y - xyz.z};
}

glm::vec3 from_opponent(const glm::vec3& o) {
  return kFromRelativeXyz * glm::vec3(o.x + o.y, o.x, o.x - o.z);
}

glm::vec3 to_hunt_lab(const glm::vec3& linear) {
  const glm::vec3 xyz = kToRelativeXyz * linear;
  const float x = lab_curve(xyz.x), y = lab_curve(xyz.y), z = lab_curve(xyz.z);
  const float lightness = 116 * y - 16;
  return {lightness, 0.01f * lightness * 500 * (x - y), 0.01f * lightness * 200 * (y - z)};
}

float color_error(const glm::vec3& p, const glm::vec3& q) {
  static const float largest = largest_distance(), knee = kKnee * largest;
  const float distance = std::pow(hyab(p, q), kColorPower);
  if (distance < knee) return kKneeError * distance / knee;
  return kKneeError + (1 - kKneeError) * (distance - knee) / (largest - knee);
}

}  // namespace vsglbench
