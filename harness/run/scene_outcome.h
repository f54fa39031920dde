// What is known of a scene and its cases, by whichever process has measured them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/case_run.h"

namespace vsglbench {

struct SceneOutcome {
  std::vector<CaseResult> cases;     // in the order in which they came to an end
  std::optional<SceneReport> scene;  // nothing when it could not be loaded
  std::optional<AaPair> aa;
  Progresses begun;  // of the cases that have not come to an end, and of the A/A twin
};

// Whether any case has an image on the disk, come to an end or not.
bool has_images(const SceneOutcome& outcome);

// What a report says of a scene before any case of it is measured.
SceneReport describe(const Scene& scene, const std::string& name, const Config& config);

// A case's name when it is measured a second time.
std::string twin_id(const std::string& case_id);

// Cases that were not run, all for the same reason.
std::vector<CaseResult> failed_cases(const std::vector<Case>& cases, const Config& config, ErrorKind kind,
                                     const std::string& message);

// `results` in the order of the experiment's cases.
void sort_like(const std::vector<Case>& cases, std::vector<CaseResult>* results);

}  // namespace vsglbench
