// All cases of one scene: one set of references, measured interleaved (A B C A B C …).
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "base/progress.h"
#include "run/case_run.h"
#include "scene/scene_file.h"

namespace vsglbench {

struct SceneOutcome {
  std::vector<CaseResult> cases;
  std::optional<SceneReport> scene;  // nothing when it could not be loaded
  std::optional<AaPair> aa;
};

struct SceneRunOptions {
  SceneOptions scenes;
  std::filesystem::path out;  // images go to out/images
  bool aa = false;            // measure the first case a second time under another name
};

// Never throws for what is wrong with a case or a scene: that is in the outcome.
SceneOutcome run_scene(Device& device, KernelLibrary& kernels, const std::string& scene, const Config& config,
                       const std::vector<Case>& cases, const SceneRunOptions& options, WallTime* wall);

// Writes images and the contact sheet of finished cases and notes their paths, relative to `out`, in `results`.
// Returns the contact sheet's path.
std::string write_images(const std::filesystem::path& out, const std::string& scene, std::vector<CaseRun>& cases,
                         std::vector<CaseResult>& results, float exposure, const Image& direct);

}  // namespace vsglbench
