#include "image/detail.h"

namespace vsglbench {
namespace {

bool is_kept(const Mask& mask, size_t i) { return mask.empty() || mask[i] != 0; }

glm::dvec3 step(const Image& image, size_t from, size_t to) {
  return glm::dvec3(image.pixels[to]) - glm::dvec3(image.pixels[from]);
}

}  // namespace

const MetricFormula& detail_formula() {
  static const MetricFormula formula{
      "detail",
      "gradient-slope-over-gain",
      "(sum(grad x . grad r) / sum(grad a . grad b)) / (mean(x) / mean(r)), r = (a+b)/2, a and b the "
      "reference's two halves",
      {}};
  return formula;
}

void DetailMeter::add(const Image& x, const Image& half0, const Image& half1, const Mask& mask) {
  check_comparable(x, half0, mask);
  check_comparable(half1, half0, mask);
  const auto neighbours = [&](size_t i, size_t j) {
    if (!is_kept(mask, j)) return;
    const glm::dvec3 a = step(half0, i, j), b = step(half1, i, j);
    test_ += glm::dot(step(x, i, j), 0.5 * (a + b));
    reference_ += glm::dot(a, b);
  };
  for (uint32_t v = 0; v < x.height; ++v) {
    for (uint32_t u = 0; u < x.width; ++u) {
      const size_t i = size_t(v) * x.width + u;
      if (!is_kept(mask, i)) continue;
      sum_x_ += glm::dot(glm::dvec3(x.pixels[i]), glm::dvec3(1));
      sum_r_ += 0.5 * glm::dot(glm::dvec3(half0.pixels[i]) + glm::dvec3(half1.pixels[i]), glm::dvec3(1));
      if (u + 1 < x.width) neighbours(i, i + 1);
      if (v + 1 < x.height) neighbours(i, i + x.width);
    }
  }
}

std::optional<Detail> DetailMeter::finish() const {
  if (!(reference_ > 0) || !(sum_x_ > 0) || !(sum_r_ > 0)) return std::nullopt;
  Detail out;
  out.slope = test_ / reference_;
  out.gain = sum_x_ / sum_r_;
  out.value = out.slope / out.gain;
  return out;
}

}  // namespace vsglbench
