// Sources: Andersson et al. 2020, Tab. 1 (contrast sensitivity), §4.2 (features).
#include "image/flip_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vsglbench {
namespace {

constexpr double kWidestTerm = 0.04;     // b of the widest Gaussian of all: one radius for all filters
constexpr double kFeatureWidth = 0.082;  // degrees: two standard deviations of the feature detectors
constexpr double pi2 = std::numbers::pi * std::numbers::pi;

// a √(π/b) exp(−π² z²/b), z in degrees.
struct Gaussian {
  double a, b;
};

Sensitivity sensitivity(const std::vector<Gaussian>& gaussians, double pixels_per_degree) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kWidestTerm / (2 * pi2)) * pixels_per_degree));
  std::vector<std::vector<double>> lines;
  double total = 0;
  for (const Gaussian& g : gaussians) {
    std::vector<double>& line = lines.emplace_back();
    double sum = 0;
    for (int x = -radius; x <= radius; ++x) {
      const double z = x / pixels_per_degree;
      line.push_back(std::sqrt(g.a * std::sqrt(std::numbers::pi / g.b)) * std::exp(-pi2 * z * z / g.b));
      sum += line.back();
    }
    total += sum * sum;
  }
  Sensitivity out;
  for (const auto& line : lines) {
    Taps& taps = out.terms.emplace_back();
    for (const double w : line) taps.push_back(static_cast<float>(w / std::sqrt(total)));
  }
  return out;
}

// Weights above 0 add up to 1 and those below to −1; without any below, all to 1.
Taps normalised(const std::vector<double>& weights) {
  double above = 0, below = 0;
  for (const double w : weights) (w > 0 ? above : below) += w;
  Taps taps;
  for (const double w : weights)
    taps.push_back(static_cast<float>(w > 0 ? w / above : below < 0 ? -w / below : 0));
  return taps;
}

void add_scaled(float weight, const float* in, float* out, size_t count) {
  for (size_t i = 0; i < count; ++i) out[i] += weight * in[i];
}

Plane length(const Plane& x, const Plane& y) {
  Plane out(x.width, x.height);
  for (size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] = std::sqrt(x.values[i] * x.values[i] + y.values[i] * y.values[i]);
  }
  return out;
}

}  // namespace

Plane filter_rows(const Plane& in, const Taps& taps) {
  const size_t radius = taps.size() / 2, width = in.width;
  Plane out(in.width, in.height);
  std::vector<float> padded(width + 2 * radius);
  for (uint32_t y = 0; y < in.height; ++y) {
    const float* row = &in.values[y * width];
    std::fill_n(padded.begin(), radius, row[0]);
    std::copy_n(row, width, padded.begin() + radius);
    std::fill_n(padded.begin() + radius + width, radius, row[width - 1]);
    for (size_t k = 0; k < taps.size(); ++k) add_scaled(taps[k], &padded[k], &out.values[y * width], width);
  }
  return out;
}

Plane filter_columns(const Plane& in, const Taps& taps) {
  const int radius = static_cast<int>(taps.size() / 2), last = static_cast<int>(in.height) - 1;
  Plane out(in.width, in.height);
  for (int y = 0; y <= last; ++y) {
    for (int k = -radius; k <= radius; ++k) {
      const size_t row = static_cast<size_t>(std::clamp(y + k, 0, last));
      add_scaled(taps[k + radius], &in.values[row * in.width], &out.values[size_t(y) * in.width], in.width);
    }
  }
  return out;
}

Plane filtered(const Plane& in, const Taps& along_rows, const Taps& along_columns) {
  return filter_columns(filter_rows(in, along_rows), along_columns);
}

Sensitivity achromatic_sensitivity(double ppd) { return sensitivity({{1, 0.0047}}, ppd); }
Sensitivity red_green_sensitivity(double ppd) { return sensitivity({{1, 0.0053}}, ppd); }
Sensitivity blue_yellow_sensitivity(double ppd) { return sensitivity({{34.1, 0.04}, {13.5, 0.025}}, ppd); }

Plane filtered(const Plane& in, const Sensitivity& sensitivity) {
  Plane sum(in.width, in.height);
  for (const Taps& taps : sensitivity.terms) {
    const Plane term = filtered(in, taps, taps);
    add_scaled(1, term.values.data(), sum.values.data(), sum.values.size());
  }
  return sum;
}

Features detect_features(const Plane& luminance, double pixels_per_degree) {
  const double deviation = 0.5 * kFeatureWidth * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  std::vector<double> flat, slope, curvature;
  for (int x = -radius; x <= radius; ++x) {
    const double t = x / deviation, g = std::exp(-0.5 * t * t);
    flat.push_back(g);
    slope.push_back(-x * g);
    curvature.push_back((t * t - 1) * g);
  }
  const Taps gaussian = normalised(flat), first = normalised(slope), second = normalised(curvature);
  const Plane smooth = filter_rows(luminance, gaussian);
  return {length(filtered(luminance, first, gaussian), filter_columns(smooth, first)),
          length(filtered(luminance, second, gaussian), filter_columns(smooth, second))};
}

}  // namespace vsglbench
