#include "image/noise_floor.h"

#include "image/flip.h"

namespace vsglbench {
namespace {

std::optional<double> mean_of(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b) return std::nullopt;
  return 0.5 * (*a + *b);
}

}  // namespace

NoiseFloor noise_floor_of(const Image& half0, const Image& half1, const Image& mean, const Mask& mask) {
  const Errors a = measure_errors(half0, mean, mask), b = measure_errors(half1, mean, mask);
  return {.smape = 0.5 * (a.smape + b.smape),
          .rmse = 0.5 * (a.rmse + b.rmse),
          .smape_lit = mean_of(a.smape_lit, b.smape_lit),
          .rrmse = mean_of(a.rrmse, b.rrmse),
          .mrse = mean_of(a.mrse, b.mrse),
          .flip = std::nullopt};
}

std::optional<double> flip_floor_of(const Image& half0, const Image& half1, const Image& mean,
                                    const Mask& mask) {
  const std::optional<FlipExposures> exposures = flip_exposures(mean, mask);
  if (!exposures) return std::nullopt;
  const FlipReference reference(mean, mask, *exposures);
  return 0.5 * (reference.compare(half0).mean + reference.compare(half1).mean);
}

}  // namespace vsglbench
