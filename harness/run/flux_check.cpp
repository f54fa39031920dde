#include "run/flux_check.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace vsglbench {
namespace {

constexpr double kExactBound = 1e-3;  // flux_bound of what puts every texel into a light
constexpr double kSumRounding = 0.01;
constexpr double kOdds = 200;

std::string fault_of_sums(const MethodInfo& method, std::span<const double> ratios) {
  const double bound = method.worst_flux_bound() + kSumRounding;
  for (const double r : ratios) {
    if (std::abs(r - 1) <= bound) continue;
    return fmt::format(
        "its lights carry {:.4g} × the texels' power, and it states {:g} … {:g} for every light set", r,
        1 - bound, 1 + bound);
  }
  return "";
}

std::string fault_of_draws(const MethodInfo& method, std::span<const double> ratios) {
  const double most = 1 + method.worst_flux_bound();
  double log_product = 0;
  for (const double r : ratios) log_product += std::log(r / most);  // -inf where a set carries nothing
  if (log_product <= std::log(kOdds)) return "";                    // a NaN goes on
  const double mean = most * std::exp(log_product / static_cast<double>(ratios.size()));
  return fmt::format(
      "its lights carry {:.4g} × the texels' power (geometric mean of {} seeds), and it states at most {:g} "
      "in the mean: "
      "a chance below 1 in {}",
      mean, ratios.size(), most, static_cast<int>(kOdds));
}

}  // namespace

std::string flux_fault(const MethodInfo& method, std::span<const double> ratios) {
  if (ratios.empty()) return "";
  return method.flux_bound <= kExactBound ? fault_of_sums(method, ratios) : fault_of_draws(method, ratios);
}

}  // namespace vsglbench
