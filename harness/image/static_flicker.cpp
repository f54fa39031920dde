#include "image/static_flicker.h"

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "image/quantile.h"

namespace vsglbench {
namespace {

constexpr double kTail = 0.99;

bool is_kept(const Mask& mask, size_t i) { return mask.empty() || mask[i] != 0; }

// A channel of a pixel: every seed's value, sorted, so that all distances come of running sums.
class Spread {
 public:
  explicit Spread(size_t seeds) : values_(seeds) {}
  void set(size_t seed, double value) { values_[seed] = {value, seed}; }
  // Adds to each seed's place the sum of its distances to all others; returns the sum over pairs.
  double add_distances(std::vector<double>* sums) {
    std::ranges::sort(values_);
    const double all = std::accumulate(values_.begin(), values_.end(), 0.0,
                                       [](double sum, const Value& v) { return sum + v.first; });
    const auto seeds = static_cast<double>(values_.size());
    double below = 0, twice = 0;
    for (size_t k = 0; k < values_.size(); ++k) {
      const auto& [value, seed] = values_[k];
      const auto rank = static_cast<double>(k);
      // Rank · value less those below; those above less their number times the value.
      const double distance =
          values_.front().first == values_.back().first
              ? 0  // rounding must not make equal images differ
              : (rank * value - below) + (all - below - value - (seeds - 1 - rank) * value);
      below += value;
      (*sums)[seed] += distance;
      twice += distance;
    }
    return twice / 2;
  }

 private:
  using Value = std::pair<double, size_t>;
  std::vector<Value> values_;
};

// `away`: of each seed, its mean distance to the others.
std::vector<double> jackknife(const std::vector<double>& away) {
  if (away.size() < 3) return {};
  const auto seeds = static_cast<double>(away.size());
  const double value = std::accumulate(away.begin(), away.end(), 0.0) / seeds;
  std::vector<double> out;
  for (const double d : away) {
    const double without = (seeds * value - 2 * d) / (seeds - 2);
    out.push_back(seeds * value - (seeds - 1) * without);
  }
  return out;
}

}  // namespace

const MetricFormula& static_flicker_formula() {
  static const MetricFormula formula{"flicker.static",
                                     "flicker-static-pairs-mean-reference",
                                     "mean over pairs of seeds |x_s - x_s'| / mean(r), one frozen frame",
                                     {}};
  return formula;
}

std::optional<StaticFlicker> static_flicker(std::span<const Image> seeds, const Image& r, const Mask& mask) {
  if (seeds.size() < 2) {
    throw fail(ErrorKind::case_failed, "static flicker is told from two seeds on; there {}: give more seeds",
               seeds.empty() ? "is none" : "is one");
  }
  check_comparable(r, r, mask);
  for (const Image& x : seeds) check_comparable(x, r, mask);
  const double pairs = static_cast<double>(seeds.size()) * static_cast<double>(seeds.size() - 1) / 2;
  std::vector<double> sums(seeds.size()), pixels;
  Spread spread(seeds.size());
  double reference = 0;
  for (size_t i = 0; i < r.pixels.size(); ++i) {
    if (!is_kept(mask, i)) continue;
    double pixel = 0;
    for (int c = 0; c < 3; ++c) {
      reference += r.pixels[i][c];
      for (size_t s = 0; s < seeds.size(); ++s) spread.set(s, seeds[s].pixels[i][c]);
      pixel += spread.add_distances(&sums);
    }
    pixels.push_back(pixel / 3 / pairs);
  }
  if (pixels.empty())
    throw fail(ErrorKind::case_failed, "no pixel shows a surface; there is nothing to compare");
  const double channels = 3 * static_cast<double>(pixels.size());
  StaticFlicker out;
  out.mean_reference = reference / channels;
  if (!(out.mean_reference > 0)) return std::nullopt;
  for (const double sum : sums)
    out.series.push_back(sum / static_cast<double>(seeds.size() - 1) / channels / out.mean_reference);
  out.value =
      std::accumulate(out.series.begin(), out.series.end(), 0.0) / static_cast<double>(out.series.size());
  out.p99 = take_quantile(pixels, kTail) / out.mean_reference;
  out.pseudovalues = jackknife(out.series);
  return out;
}

}  // namespace vsglbench
