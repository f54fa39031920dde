// Order statistics of many values.
#pragma once

#include <algorithm>
#include <vector>

namespace vsglbench {

// Quantile by linear interpolation between order statistics (type 7); reorders `values`.
template <class T>
double take_quantile(std::vector<T>& values, double p) {
  const double position = p * static_cast<double>(values.size() - 1);
  const auto k = static_cast<size_t>(position);
  std::nth_element(values.begin(), values.begin() + k, values.end());
  const double lo = values[k];
  if (k + 1 == values.size()) return lo;
  const double hi = *std::min_element(values.begin() + k + 1, values.end());
  return lo + (position - static_cast<double>(k)) * (hi - lo);
}

}  // namespace vsglbench
