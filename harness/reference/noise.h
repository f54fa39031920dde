// What the batches say of the noise of the whole image.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "reference/footprint.h"

namespace vsglbench {

// Mean over the three channels of all pixels that see a surface; at least one must.
inline double mean_of_batch(const std::vector<glm::vec3>& estimate,
                            const std::vector<Footprint>& footprints) {
  double sum = 0, n = 0;
  for (size_t i = 0; i < estimate.size(); ++i) {
    if (!footprints[i].valid) continue;
    sum += double(estimate[i].x) + estimate[i].y + estimate[i].z;
    n += 3;
  }
  return sum / n;
}

// Standard error of the mean of independent values (at least two), over that mean; 0 where they are all 0.
inline double relative_standard_error(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return mean > 0 ? std::sqrt(squares / (n * (n - 1))) / mean : 0;
}

}  // namespace vsglbench
