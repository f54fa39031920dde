// FLIP's filters [Andersson et al. 2020, §4.1.1 and §4.2], all of them separable: what the eye blurs, and
// what it takes for edges and points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vsglbench {

// One float a pixel, row-major.
struct Plane {
  uint32_t width = 0, height = 0;
  std::vector<float> values;
  Plane() = default;
  Plane(uint32_t w, uint32_t h) : width(w), height(h), values(std::size_t(w) * h) {}
};

using Taps = std::vector<float>;  // 2 radius + 1 weights, the middle one for the pixel itself

// Along rows and along columns; beyond the border the border's pixel goes on. `add`: onto what `out` holds.
Plane filter_rows(const Plane& in, const Taps& taps);
Plane filter_columns(const Plane& in, const Taps& taps);
Plane filtered(const Plane& in, const Taps& along_rows, const Taps& along_columns);

// Contrast sensitivity of each opponent channel: a sum of `terms`, each the same along rows and columns. All
// weights of a channel add up to 1.
struct Sensitivity {
  std::vector<Taps> terms;
};
Sensitivity achromatic_sensitivity(double pixels_per_degree);
Sensitivity red_green_sensitivity(double pixels_per_degree);
Sensitivity blue_yellow_sensitivity(double pixels_per_degree);
Plane filtered(const Plane& in, const Sensitivity& sensitivity);

// Lengths of the two-dimensional responses to edges (first derivative of a Gaussian) and points (second).
struct Features {
  Plane edges, points;
};
Features detect_features(const Plane& luminance, double pixels_per_degree);

}  // namespace vsglbench
