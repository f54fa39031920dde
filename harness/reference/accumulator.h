// Mean, halves and variance of the mean of a pixel's batches.
#pragma once

#include <vector>

#include "image/image.h"

namespace vsglbench {

class BatchAccumulator {
 public:
  BatchAccumulator(uint32_t width, uint32_t height)
      : width_(width), height_(height), pixels_(size_t(width) * height) {}

  // Adds one estimate of a pixel; the batches of a pixel come in order, even and odd ones by turns.
  void add(size_t pixel, uint32_t batch, const glm::vec3& estimate) {
    Sums& s = pixels_[pixel];
    const glm::dvec3 x(estimate);
    s.half[batch % 2] += x;
    s.squares += x * x;
  }

  // After `batches` (even, >= 2) have been added everywhere.
  Image mean(uint32_t batches) const;
  Image half(uint32_t which, uint32_t batches) const;
  Image variance_of_mean(uint32_t batches) const;

 private:
  struct Sums {
    glm::dvec3 half[2] = {glm::dvec3(0), glm::dvec3(0)}, squares{0};
  };
  template <class F>
  Image map(F f) const {
    Image image(width_, height_);
    for (size_t i = 0; i < pixels_.size(); ++i) image.pixels[i] = glm::vec3(f(pixels_[i]));
    return image;
  }
  uint32_t width_, height_;
  std::vector<Sums> pixels_;
};

inline Image BatchAccumulator::mean(uint32_t batches) const {
  return map([&](const Sums& s) { return (s.half[0] + s.half[1]) / double(batches); });
}

inline Image BatchAccumulator::half(uint32_t which, uint32_t batches) const {
  return map([&](const Sums& s) { return s.half[which] / (0.5 * batches); });
}

inline Image BatchAccumulator::variance_of_mean(uint32_t batches) const {
  const double n = batches;
  return map([&](const Sums& s) {
    const glm::dvec3 sum = s.half[0] + s.half[1];
    return glm::max((s.squares - sum * sum / n) / (n * (n - 1)), glm::dvec3(0));
  });
}

}  // namespace vsglbench
