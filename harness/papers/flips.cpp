#include "papers/flips.h"

#include <algorithm>
#include <array>
#include <map>

namespace vsglbench {
namespace {

using TrialKey = std::array<std::string, 5>;

std::map<TrialKey, ClaimTrial> by_key(const Json& papers) {
  std::map<TrialKey, ClaimTrial> out;
  for (const Json& exhibit : papers.at("exhibits")) {
    for (const Json& json : exhibit.at("trials")) {
      const ClaimTrial t = trial_from_json(json);
      out[{t.exhibit, exhibit.at("scale"), t.claim, t.place, t.metric}] = t;
    }
  }
  return out;
}

}  // namespace

Flips flips(const Json& before, const Json& after) {
  const auto certain = [](Ruling r) { return r != Ruling::undecided && r != Ruling::not_run; };
  const std::map<TrialKey, ClaimTrial> old = by_key(before), now = by_key(after);
  Flips out;
  for (const auto& [key, t] : now) {
    const auto at = old.find(key);
    if (at == old.end()) continue;
    ++out.compared;
    if (at->second.ruling != t.ruling)
      out.changed.push_back({at->second, t, certain(at->second.ruling) && certain(t.ruling)});
  }
  // Of what was asked for anew at this scale.
  const auto tried = [&](const TrialKey& key) {
    return std::ranges::any_of(
        now, [&](const auto& item) { return item.first[0] == key[0] && item.first[1] == key[1]; });
  };
  for (const auto& [key, t] : old) out.vanished += !now.contains(key) && tried(key);
  return out;
}

std::string flip_text(const Flip& flip) {
  const auto number = [](const ClaimTrial& t) {
    if (!t.ratio) return t.figures;
    if (!t.ci95) return fmt::format("{:.3g}", *t.ratio);
    return fmt::format("{:.3g} [{:.3g}, {:.3g}]", *t.ratio, t.ci95->lo, t.ci95->hi);
  };
  const std::string what = !flip.lost                            ? "can be told otherwise"
                           : flip.before.ruling == Ruling::holds ? "no longer holds"
                           : flip.after.ruling == Ruling::holds  ? "now holds"
                                                                 : std::string(name(flip.after.ruling));
  return fmt::format("{}: {}: {} ({}, {}, {}; was {}: {}, is {}: {})", flip.after.source, what,
                     flip.after.text, flip.after.exhibit, flip.after.place, flip.after.metric,
                     name(flip.before.ruling), number(flip.before), name(flip.after.ruling),
                     number(flip.after));
}

}  // namespace vsglbench
