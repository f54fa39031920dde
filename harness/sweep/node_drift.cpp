#include "sweep/node_drift.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "sweep/shard_folder.h"

namespace vsglbench {
namespace {

bool has_times(const AnchorRun& run) {
  return !run.times_ms.empty() && std::ranges::all_of(run.times_ms, [](double ms) { return ms > 0; });
}

}  // namespace

bool NodeDrift::beyond_noise() const {
  const double factor = 1 + noise.value_or(0);
  return ratio.ci95.lo > factor || ratio.ci95.hi < 1 / factor;
}

std::optional<NodeDrift> drift_of(const std::vector<AnchorRun>& runs, std::optional<double> noise) {
  std::vector<const AnchorRun*> timed;
  for (const AnchorRun& run : runs)
    if (has_times(run)) timed.push_back(&run);
  if (timed.size() < 2) return std::nullopt;
  NodeDrift drift{.blocks = timed.size(), .noise = noise};
  double most = -1;
  for (size_t i = 1; i < timed.size(); ++i) {
    const Ratio ratio = median_ratio(timed[i]->times_ms, timed[0]->times_ms);
    if (std::abs(std::log(ratio.value)) <= most) continue;
    most = std::abs(std::log(ratio.value));
    drift.ratio = ratio;
    drift.farthest = {timed[i]->shard, timed[i]->where, {}};
  }
  drift.first = {timed[0]->shard, timed[0]->where, {}};
  return drift;
}

std::string drift_text(const NodeDrift& d) {
  const std::string noise =
      d.noise ? fmt::format("the A/A noise of {:.1f} %", 100 * *d.noise) : "an unknown A/A noise";
  return fmt::format(
      "the anchor {} took {:.3f} [{:.3f}, {:.3f}] times as long in shard {} on {} as in shard {} on {}, {} "
      "{}{}",
      d.anchor, d.ratio.value, d.ratio.ci95.lo, d.ratio.ci95.hi, shard_name(d.farthest.shard),
      d.farthest.where, shard_name(d.first.shard), d.first.where, d.beyond_noise() ? "beyond" : "within",
      noise, d.beyond_noise() ? ": compare times of this scene within a shard only" : "");
}

}  // namespace vsglbench
