#include "measure/creep.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vsglbench {
namespace {

std::vector<double> sorted(std::span<const double> figures) {
  std::vector<double> out(figures.begin(), figures.end());
  std::ranges::sort(out);
  return out;
}

// Back from the end, as long as the level lies beyond a share of the change.
size_t stays_beyond(std::span<const double> figures, double share) {
  const auto level = [&](size_t begin) { return std::log(median(figures.subspan(begin, kCreepEnd))); };
  const size_t end = figures.size() - kCreepEnd;
  const double base = level(0), change = level(end) - base;
  size_t begin = end;
  while (begin > 0 && (level(begin - 1) - base) / change > share) --begin;
  return begin + kCreepEnd / 2;
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

  return Creep{stays_beyond(figures, 0.25), stays_beyond(figures, 0.75), median_ratio(last, first)};
}

}  // namespace vsglbench
