// Fireflies: pixels brighter than anything that the reference has nearby.
#pragma once

#include <optional>

#include "image/metrics.h"

namespace vsglbench {

// A spike's luminance is above both: so many times the reference's largest within the 3×3 pixels around it,
// and so many times the reference's mean. The first tells it from light that is misplaced by a pixel or too
// bright as a whole, the second from noise where next to no light is.
inline constexpr double kSpikeOverNearby = 4, kSpikeOverMean = 2;

// The share of the mask's pixels that are spikes, 0 … 1. The mean is over the mask; what is nearby is not:
// light that only the reference sees there explains a bright pixel as well. Nothing for a black reference,
// beside which all light would be one. Throws Error(case_failed) as measure_errors does.
std::optional<double> spike_share(const Image& x, const Image& r, const Mask& mask = {});

}  // namespace vsglbench
