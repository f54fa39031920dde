// All cases of one scene: one set of references, measured interleaved (A B C A B C …).
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "run/case_run.h"
#include "scene/scene_file.h"

namespace vsglbench {

struct SceneOutcome {
  std::vector<CaseResult> cases;     // one for each that was asked for, in their order
  std::optional<SceneReport> scene;  // nothing when it could not be loaded
  std::optional<AaPair> aa;
};

struct SceneRunOptions {
  SceneOptions scenes;
  std::filesystem::path out;  // images go to out/images
  bool aa = false;            // measure the first sound case a second time under another name
};

// Never throws: what is wrong with a case or a scene is in the outcome.
SceneOutcome run_scene(Device& device, KernelLibrary& kernels, const std::string& scene, const Config& config,
                       const std::vector<Case>& cases, const SceneRunOptions& options, WallTime* wall);

// Cases that were not run, all for the same reason.
std::vector<CaseResult> failed_cases(const std::vector<Case>& cases, const Config& config,
                                     const std::string& kind, const std::string& message);

}  // namespace vsglbench
