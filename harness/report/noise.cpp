#include "report/noise.h"

#include <algorithm>
#include <map>

#include "report/case_names.h"
#include "report/metric_cell.h"

namespace vsglbench {
namespace {

bool all_positive(const Summary& time) {
  return std::all_of(time.samples.begin(), time.samples.end(), [](double s) { return s > 0; });
}

const AaPair* pair_of(const Report& report, const std::string& scene) {
  for (const AaPair& pair : report.aa) {
    if (pair.scene == scene) return &pair;
  }
  return nullptr;
}

std::optional<PassStage> stage_of(const std::string& column) {
  if (column == "fixed") return PassStage::draw;
  if (column == "importance") return PassStage::importance;
  if (column == "visibility") return PassStage::visibility;
  if (column == "shade") return PassStage::shade;
  return std::nullopt;
}

}  // namespace

std::string percent(double share) { return significant(100 * share, 2) + " %"; }

const std::vector<std::string>& time_columns() {
  static const std::vector<std::string> names = {
      "fixed",      "generate", "generate.gbuffer", "generate.rsm", "importance",
      "visibility", "shade",    "method",           "rays",         "frame"};
  return names;
}

bool counts_in(const std::string& column, const PassId& pass) {
  if (column == "frame") return true;
  if (column == "method") return pass.stage != PassStage::draw;
  if (const auto stage = stage_of(column)) return pass.stage == *stage;
  if (!column.starts_with("generate") || pass.stage != PassStage::generate) return false;
  if (column == "generate") return true;
  return pass.half == (column == "generate.rsm" ? Half::rsm : Half::gbuffer);
}

std::optional<Summary> time_of(const CaseResult& c, const std::string& column) {
  if (column == "generate") return c.generate ? std::optional(c.generate->total) : std::nullopt;
  if (column == "generate.gbuffer") return generate_time(c.passes, Half::gbuffer);
  if (column == "generate.rsm") return generate_time(c.passes, Half::rsm);
  if (!c.frame) return std::nullopt;
  if (column == "method") return c.frame->method;
  if (column == "rays") return c.frame->host_visibility;
  if (const auto stage = stage_of(column)) return stage_time(c.passes, *stage);
  if (column == "frame") return c.frame->span;
  throw std::logic_error("no time is named " + column);
}

std::optional<Summary> time_of_passes(const CaseResult& c, const std::string& glob) {
  return pass_time(c.passes, [&](const PassId& pass) { return matches_glob(pass.name(), glob); });
}

std::string column_of_passes(const Report& report, const std::string& scene, const std::string& glob) {
  std::map<std::string, PassId> meant;  // the cases of a scene have few passes, and most of them in common
  for (const CaseResult& c : report.cases) {
    if (c.scene != scene) continue;
    for (const PassTiming& p : c.passes) meant.emplace(p.pass.name(), p.pass);
  }
  std::erase_if(meant, [&](const auto& pass) { return !matches_glob(pass.first, glob); });
  if (meant.empty()) return "frame";
  for (const char* column : {"generate", "importance", "visibility", "shade"}) {
    const auto counts = [&](const auto& pass) { return counts_in(column, pass.second); };
    if (std::ranges::all_of(meant, counts)) return column;
  }
  return "frame";
}

AaPair aa_pair(const CaseResult& original, const CaseResult& twin) {
  AaPair pair{original.scene, original.id, twin.id, {}};
  for (const std::string& column : time_columns()) {
    const auto a = time_of(original, column), b = time_of(twin, column);
    if (!a || !b || !all_positive(*a) || !all_positive(*b)) continue;
    const Ratio ratio = median_ratio(a->samples, b->samples);
    pair.times.push_back({column, ratio, noise_floor(ratio)});
  }
  return pair;
}

const TimeNoise* noise_of(const Report& report, const std::string& scene, const std::string& column) {
  const AaPair* pair = pair_of(report, scene);
  if (!pair) return nullptr;
  for (const TimeNoise& time : pair->times) {
    if (time.column == column) return &time;
  }
  return nullptr;
}

std::optional<std::string> noise_over(const Report& report, double limit) {
  for (const CaseResult& c : report.cases) {
    if (c.status == Status::ok && !pair_of(report, c.scene))
      return fmt::format("{}: no case was measured twice, so its noise is unknown", c.scene);
  }
  const AaPair* noisy = nullptr;
  const TimeNoise* worst = nullptr;
  for (const AaPair& pair : report.aa) {
    for (const TimeNoise& time : pair.times) {
      if (worst && time.noise_floor <= worst->noise_floor) continue;
      noisy = &pair;
      worst = &time;
    }
  }
  if (!worst || worst->noise_floor <= limit) return std::nullopt;
  return fmt::format("{}: the time '{}' of one case measured twice differs by up to {}, over {:g} %",
                     noisy->scene, worst->column, percent(worst->noise_floor), 100 * limit);
}

}  // namespace vsglbench
