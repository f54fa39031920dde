#include "measure/verdict.h"

#include <algorithm>
#include <stdexcept>

namespace vsglbench {
namespace {

constexpr int kResamples = 1000;

void require_positive(std::span<const double> samples) {
  for (const double s : samples) {
    if (!(s > 0)) throw std::invalid_argument("a ratio of times needs times above 0");
  }
}

}  // namespace

Ratio median_ratio(std::span<const double> a, std::span<const double> b, uint64_t seed) {
  require_positive(a);
  require_positive(b);
  MedianBootstrap of_a(a, seed), of_b(b, seed + 1);
  std::vector<double> ratios(kResamples);
  for (double& r : ratios) r = of_a.draw() / of_b.draw();
  std::sort(ratios.begin(), ratios.end());
  return {median(a) / median(b), {quantile_sorted(ratios, 0.025), quantile_sorted(ratios, 0.975)}};
}

double noise_floor(const Ratio& aa) { return std::max(aa.ci95.hi, 1 / aa.ci95.lo) - 1; }

std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::faster:
      return "faster";
    case Verdict::slower:
      return "slower";
    case Verdict::ambiguous:
      return "ambiguous";
  }
  return "";
}

Verdict compare_times(std::span<const double> a, std::span<const double> b, double noise_floor,
                      uint64_t seed) {
  const Interval ci_a = bootstrap_median_ci95(a, kResamples, seed);
  const Interval ci_b = bootstrap_median_ci95(b, kResamples, seed + 1);
  const Interval ratio = median_ratio(a, b, seed).ci95;
  const double beyond = 1 + std::max(noise_floor, 0.0);
  if (ci_a.hi < ci_b.lo && ratio.hi < 1 / beyond) return Verdict::faster;
  if (ci_a.lo > ci_b.hi && ratio.lo > beyond) return Verdict::slower;
  return Verdict::ambiguous;
}

}  // namespace vsglbench
