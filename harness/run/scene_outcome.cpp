#include "run/scene_outcome.h"

#include <algorithm>

namespace vsglbench {
namespace {

// In the frame of the scene's first case; whole frames alone have errors to tell in it.
std::optional<Crop> region_of(const Scene& scene, const std::string& name, const Config& config) {
  const auto first = std::ranges::find(config.cases, name, &Case::scene);
  if (!scene.region || config.measure != Measure::frame || first == config.cases.end()) return std::nullopt;
  return pixels_of(*scene.region, first->frame.width, first->frame.height);
}

}  // namespace

bool has_images(const SceneOutcome& outcome) {
  const auto has = [](const CaseResult& c) { return !c.images.empty(); };
  return std::ranges::any_of(outcome.cases, has) ||
         std::ranges::any_of(outcome.begun, [&](const auto& begun) {
           return begun.second.scored && has(begun.second.scored->result);
         });
}

SceneReport describe(const Scene& scene, const std::string& name, const Config& config) {
  SceneReport report;
  report.name = name;
  report.hash = scene.hash;
  report.triangles = scene.triangles.size();
  report.warnings = scene.warnings;
  report.light_flux = frustum_flux(scene.light);
  report.region = region_of(scene, name, config);
  return report;
}

std::string twin_id(const std::string& case_id) { return case_id + " (A/A twin)"; }

std::vector<CaseResult> failed_cases(const std::vector<Case>& cases, const Config& config, ErrorKind kind,
                                     const std::string& message) {
  std::vector<CaseResult> results;
  for (const Case& c : cases) {
    WallTime none;
    CaseRun run(c, config, &none);
    run.fail_with(kind, message);
    results.push_back(run.result());
  }
  return results;
}

void sort_like(const std::vector<Case>& cases, std::vector<CaseResult>* results) {
  const auto place = [&](const CaseResult& r) {
    return std::find_if(cases.begin(), cases.end(), [&](const Case& c) { return c.id == r.id; });
  };
  std::stable_sort(results->begin(), results->end(),
                   [&](const CaseResult& a, const CaseResult& b) { return place(a) < place(b); });
}

}  // namespace vsglbench
