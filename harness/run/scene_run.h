// All cases of one scene: one set of references. First every case is looked at: its seeds are rendered,
// compared and written. Then all are timed interleaved (A B C A B C …), and nothing else is done between.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "run/scene_outcome.h"
#include "scene/scene_file.h"

namespace vsglbench {

// Is told everything as soon as it is known.
class SceneObserver {
 public:
  virtual ~SceneObserver() = default;
  virtual void now(const Activity& activity) = 0;
  virtual void described(const SceneReport& scene) = 0;  // may come again with more in it
  virtual void scored(const ScoredCase& scored) = 0;     // its images are on the disk
  virtual void timed(const std::string& case_id, const FrameTimes& frame) = 0;
  virtual void concluded(const CaseResult& result) = 0;  // the first one counts
  virtual void paired(const AaPair& pair) = 0;
};

struct SceneRunOptions {
  SceneOptions scenes;
  std::filesystem::path out;  // images go to out/images
  std::string device_uuid;    // whose clocks are watched; empty: none
  bool aa = false;            // measure the first sound case a second time under another name
};

// Concludes each of `cases`; then the contact sheet, which shows those of `earlier`, too: cases that another
// process has measured. What that has begun is gone on with. Throws Error(device_lost) when the device is
// lost; whatever else is wrong with a case or with the scene is in the results.
void run_scene(Device& device, KernelLibrary& kernels, const std::string& scene, const Config& config,
               const std::vector<Case>& cases, const SceneOutcome& earlier, const SceneRunOptions& options,
               SceneObserver& observer, WallTime* wall);

}  // namespace vsglbench
