// Sources: the formulas stand in metrics.h; ids and constants go into every report.
#include "image/metrics.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/flip.h"
#include "image/quantile.h"

namespace vsglbench {
namespace {

constexpr double kMrseFactor = 0.01, kLitFactor = 0.1;  // of the reference's mean luminance
constexpr float kKeyQuantile = 0.95f, kKeyLuminance = 0.8f;

bool is_kept(const Mask& mask, size_t i) { return mask.empty() || mask[i] != 0; }

double luminance64(const glm::vec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

// |x−r| / ((|x|+|r|)/2), 0/0 → 0.
double symmetric_relative(double x, double r) {
  const double sum = std::abs(x) + std::abs(r);
  return sum > 0 ? std::abs(x - r) / (0.5 * sum) : 0;
}

void check_mask(const Image& r, const Mask& mask) {
  if (!mask.empty() && mask.size() != r.pixels.size()) {
    throw fail(ErrorKind::case_failed, "the mask has {} pixels but the image {}", mask.size(),
               r.pixels.size());
  }
}

void check_finite(const Image& image, const char* what) {
  const Health health = check_health(image);
  if (health.finite()) return;
  throw fail(ErrorKind::case_failed, "{} holds {} NaN and {} Inf pixels, the first at ({}, {})", what,
             health.nan, health.inf, health.first_bad->x, health.first_bad->y);
}

// Means over the kept pixels; of channels where they concern x, or r alone.
struct Means {
  uint64_t pixels = 0;
  double x = 0, r = 0, luminance_r = 0, symmetric = 0, square = 0;
};

Means accumulate(const Image& x, const Image& r, const Mask& mask) {
  Means m;
  for (size_t i = 0; i < r.pixels.size(); ++i) {
    if (!is_kept(mask, i)) continue;
    ++m.pixels;
    m.luminance_r += luminance64(r.pixels[i]);
    for (int c = 0; c < 3; ++c) {
      const double xc = x.pixels[i][c], rc = r.pixels[i][c];
      m.x += xc;
      m.r += rc;
      m.symmetric += symmetric_relative(xc, rc);
      m.square += (xc - rc) * (xc - rc);
    }
  }
  if (m.pixels == 0)
    throw fail(ErrorKind::case_failed, "no pixel shows a surface; there is nothing to compare");
  const double values = 3.0 * static_cast<double>(m.pixels);
  m.luminance_r /= static_cast<double>(m.pixels);
  for (double* sum : {&m.x, &m.r, &m.symmetric, &m.square}) *sum /= values;
  return m;
}

double mean_relative_square(const Image& x, const Image& r, const Mask& mask, double epsilon,
                            uint64_t pixels) {
  double sum = 0;
  for (size_t i = 0; i < r.pixels.size(); ++i) {
    if (!is_kept(mask, i)) continue;
    for (int c = 0; c < 3; ++c) {
      const double rc = r.pixels[i][c], d = x.pixels[i][c] - rc;
      sum += d * d / (rc * rc + epsilon);
    }
  }
  return sum / (3.0 * static_cast<double>(pixels));
}

struct Lit {
  double smape = 0, share = 0;
};

// `mean`: of the luminance of r, above 0, so that at least one pixel is lit.
Lit measure_lit(const Image& x, const Image& r, const Mask& mask, double mean, uint64_t pixels) {
  uint64_t lit = 0;
  double sum = 0;
  for (size_t i = 0; i < r.pixels.size(); ++i) {
    if (!is_kept(mask, i) || luminance64(r.pixels[i]) <= kLitFactor * mean) continue;
    ++lit;
    for (int c = 0; c < 3; ++c) sum += symmetric_relative(x.pixels[i][c], r.pixels[i][c]);
  }
  return {100 * sum / (3.0 * static_cast<double>(lit)),
          static_cast<double>(lit) / static_cast<double>(pixels)};
}

double luminance_error_p99_9(const Image& x, const Image& r, const Mask& mask) {
  std::vector<double> errors;
  for (size_t i = 0; i < r.pixels.size(); ++i) {
    if (is_kept(mask, i)) errors.push_back(std::abs(luminance64(x.pixels[i]) - luminance64(r.pixels[i])));
  }
  return take_quantile(errors, 0.999);
}

}  // namespace

void check_comparable(const Image& x, const Image& r, const Mask& mask) {
  if (x.width != r.width || x.height != r.height) {
    throw fail(ErrorKind::case_failed, "the image is {}x{} but its reference {}x{}", x.width, x.height,
               r.width, r.height);
  }
  check_mask(r, mask);
  check_finite(x, "the image");
  check_finite(r, "the reference");
}

Health check_health(const Image& image) {
  Health health;
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    bool nan = false, inf = false, negative = false;
    for (int c = 0; c < 3; ++c) {
      const float v = image.pixels[i][c];
      nan |= std::isnan(v);
      inf |= std::isinf(v);
      negative |= v < 0;
    }
    health.nan += nan;
    health.inf += inf;
    health.negative += negative;
    if ((nan || inf) && !health.first_bad) health.first_bad = glm::uvec2(i % image.width, i / image.width);
  }
  return health;
}

const MetricFormula& formula(Metric metric) {
  static const std::array<MetricFormula, kMetrics.size()> formulas = {{
      {"smape", "smape-0-200", "100 mean(|x-r| / ((|x|+|r|)/2)), 0/0 = 0", {{"scale", 100}}},
      {"smape_lit",
       "smape-0-200-lit",
       "smape over the pixels with luminance of r > factor mean luminance of r",
       {{"scale", 100}, {"lit_factor", kLitFactor}}},
      {"rmse", "rmse-root", "sqrt(mean((x-r)^2))", {}},
      {"rrmse", "rrmse-mean-reference", "sqrt(mean((x-r)^2)) / mean(r)", {}},
      {"mrse",
       "mrse-mean-luminance",
       "mean((x-r)^2 / (r^2+e)), e = (factor mean luminance of r)^2",
       {{"epsilon_factor", kMrseFactor}}},
      {"bias", "bias-relative-mean", "(mean x - mean r) / mean r", {}},
      {"flip",
       "hdr-flip-2021",
       "mean over pixels of the largest LDR-FLIP of all exposures, tone-mapped with ACES",
       {{"pixels_per_degree", kFlipPixelsPerDegree}}},
  }};
  return formulas[static_cast<size_t>(metric)];
}

std::optional<double> Errors::value(Metric metric) const {
  switch (metric) {
    case Metric::smape:
      return smape;
    case Metric::smape_lit:
      return smape_lit;
    case Metric::rmse:
      return rmse;
    case Metric::rrmse:
      return rrmse;
    case Metric::mrse:
      return mrse;
    case Metric::bias:
      return bias;
    case Metric::flip:
      return flip;
  }
  return std::nullopt;
}

Errors measure_errors(const Image& x, const Image& r, const Mask& mask) {
  check_comparable(x, r, mask);
  const Means m = accumulate(x, r, mask);
  Errors e;
  e.pixels = m.pixels;
  e.smape = 100 * m.symmetric;
  e.rmse = std::sqrt(m.square);
  if (m.r > 0) {
    e.rrmse = e.rmse / m.r;
    e.bias = (m.x - m.r) / m.r;
  }
  const double root = kMrseFactor * m.luminance_r;
  if (root > 0) {
    e.mrse = mean_relative_square(x, r, mask, root * root, m.pixels);
    const Lit lit = measure_lit(x, r, mask, m.luminance_r, m.pixels);
    e.smape_lit = lit.smape;
    e.lit_share = lit.share;
    e.p99_9 = luminance_error_p99_9(x, r, mask) / m.luminance_r;
  }
  return e;
}

ErrorQuantiles error_quantiles(const Image& x, const Image& r, const Mask& mask) {
  check_comparable(x, r, mask);
  std::vector<double> errors;
  for (size_t i = 0; i < r.pixels.size(); ++i) {
    if (is_kept(mask, i)) {
      errors.push_back(100 * symmetric_relative(luminance64(x.pixels[i]), luminance64(r.pixels[i])));
    }
  }
  if (errors.empty())
    throw fail(ErrorKind::case_failed, "no pixel shows a surface; there is nothing to compare");
  return {take_quantile(errors, 0.5), take_quantile(errors, 0.99), take_quantile(errors, 0.999)};
}

float auto_exposure(const Image& reference, const Mask& mask) {
  check_mask(reference, mask);
  std::vector<float> values;
  for (size_t i = 0; i < reference.pixels.size(); ++i) {
    const float v = luminance(reference.pixels[i]);
    if (is_kept(mask, i) && std::isfinite(v)) values.push_back(v);
  }
  if (values.empty()) return 1;
  double key = take_quantile(values, kKeyQuantile);
  if (key <= 0) key = *std::max_element(values.begin(), values.end());  // lit in fewer than 5 % of its pixels
  const double exposure = key > 0 ? kKeyLuminance / key : 1;
  return std::isfinite(static_cast<float>(exposure)) ? static_cast<float>(exposure) : 1;
}

}  // namespace vsglbench
