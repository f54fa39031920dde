#include "measure/creep.h"

#include <algorithm>
#include <vector>

namespace vsglbench {
namespace {

std::vector<double> sorted(std::span<const double> figures) {
  std::vector<double> out(figures.begin(), figures.end());
  std::ranges::sort(out);
  return out;
}

}  // namespace

std::optional<Creep> creep_of(std::span<const double> figures, double noise) {
  if (figures.size() < 2 * kCreepEnd) return std::nullopt;
  if (std::ranges::any_of(figures, [](double v) { return !(v > 0); })) return std::nullopt;
  const auto first = figures.first(kCreepEnd), last = figures.last(kCreepEnd);

  // Whether the ends lie apart. One figure of each may be astray.
  const std::vector<double> a = sorted(first), b = sorted(last);
  const double beyond = 1 + noise;
  const bool up = b[1] > beyond * a[kCreepEnd - 2], down = b[kCreepEnd - 2] * beyond < a[1];
  if (!up && !down) return std::nullopt;

  // Back from the end, as long as the level stays beyond the noise.
  const double base = median(first);
  size_t index = figures.size() - kCreepEnd;
  while (index > 0) {
    const double ratio = median(figures.subspan(index - 1, kCreepEnd)) / base;
    if (up ? ratio <= beyond : ratio * beyond >= 1) break;
    --index;
  }
  return Creep{index, median_ratio(last, first)};
}

}  // namespace vsglbench
