// All cases of a scene timed interleaved (A B C A B C …), the A/A twin among them.
#pragma once

#include <functional>
#include <vector>

#include "run/scene_clocks.h"
#include "run/scene_run.h"

namespace vsglbench {

class SceneRounds {
 public:
  // `twin`: the last of `runs` is one of the others a second time. `conclude` is called once for each but the
  // twin, as soon as it is finished. All outlive it.
  SceneRounds(std::vector<CaseRun>& runs, bool twin, const Config& config, SceneObserver& observer,
              std::function<void(CaseRun&)> conclude);
  // Until all are concluded. The clocks' readings go into `report`.
  void run(SceneClocks& clocks, SceneReport* report);

 private:
  template <class Frame>
  void every_case(const Frame& frame);
  bool has_unfinished() const;
  void warm_up();
  void conclude_finished();
  CaseRun* original_of_twin();
  void pair_twin();
  void conclude_twin();

  std::vector<CaseRun>& runs_;
  const bool twin_;
  const Config& config_;
  SceneObserver& observer_;
  std::function<void(CaseRun&)> conclude_;
};

}  // namespace vsglbench
