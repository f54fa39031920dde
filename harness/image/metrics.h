// How far an image is from its reference: the formulas of the report, in double precision.
//
// x is the image under test, r its reference, both linear RGB. Means run over the three channels of every
// pixel that the mask keeps.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"

namespace vsglbench {

// One byte a pixel, row-major, not 0 where the camera sees a surface. An empty mask keeps every pixel.
using Mask = std::vector<uint8_t>;

// Pixels with at least one such channel, over the whole image (a NaN on the background is a fault too).
struct Health {
  uint64_t nan = 0, inf = 0, negative = 0;
  std::optional<glm::uvec2> first_bad;  // (x, y) of the first pixel, in row order, with a NaN or an Inf
  bool finite() const { return nan == 0 && inf == 0; }
};
Health check_health(const Image& image);

// The formulas. A report names them by id; numbers of different ids are never compared.
enum class Metric { smape, smape_lit, rmse, rrmse, mrse, bias, flip };
inline constexpr std::array kMetrics = {Metric::smape, Metric::smape_lit, Metric::rmse, Metric::rrmse,
                                        Metric::mrse,  Metric::bias,      Metric::flip};

struct MetricFormula {
  std::string name;        // "smape"
  std::string id;          // "smape-0-200"
  std::string expression;  // for a reader
  std::map<std::string, double> constants;
};
const MetricFormula& formula(Metric metric);

// smape      100 · mean(|x−r| / ((|x|+|r|)/2)), 0/0 → 0; percent, 0 … 200
// smape_lit  smape over the pixels whose luminance of r is above 0.1 of its mean: where most of a picture is
//            black, smape counts any glow there as 200 %
// rmse       √mean((x−r)²); W/m²/sr
// rrmse      rmse / mean(r)
// mrse       mean((x−r)² / (r²+ε)), ε = (0.01 · mean luminance of r)²
// bias       (mean x − mean r) / mean r
// flip       HDR-FLIP, mean over pixels, 0 … 1; measured by measure_flip (flip.h) alone
// smape_lit, rrmse, mrse, bias and flip have no value where the reference is black (its mean is not above 0).
struct Errors {
  double smape = 0, rmse = 0;
  std::optional<double> rrmse, mrse, bias;
  uint64_t pixels = 0;                                         // that the mask kept
  std::optional<double> smape_lit, lit_share, flip, flip_p99;  // lit_share: of the pixels, 0 … 1
  // 99.9th percentile over pixels of |Y(x)−Y(r)| / mean Y(r), Y the luminance: the height of spikes, which a
  // relative error, at most 200 %, does not tell. No value where the reference is black.
  std::optional<double> p99_9;
  std::optional<double> value(Metric metric) const;
};

// All but flip. Throws Error(case_failed) when sizes differ, the mask keeps nothing, or either image holds a
// NaN or Inf: those are never averaged away.
Errors measure_errors(const Image& x, const Image& r, const Mask& mask = {});
// The same refusals.
void check_comparable(const Image& x, const Image& r, const Mask& mask);

// Quantiles over pixels of the symmetric relative error |x−r|/((|x|+|r|)/2) of luminance, in percent.
struct ErrorQuantiles {
  double p50 = 0, p99 = 0, p999 = 0;
};
ErrorQuantiles error_quantiles(const Image& x, const Image& r, const Mask& mask = {});

// For previews: the one exposure of a scene maps the 95th percentile of the reference's
// luminance to 0.8 (linear, before the tone curve). 1 when the reference is black.
float auto_exposure(const Image& reference, const Mask& mask = {});

}  // namespace vsglbench
