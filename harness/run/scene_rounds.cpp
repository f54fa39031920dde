#include "run/scene_rounds.h"

#include <algorithm>

#include "base/progress.h"
#include "measure/stopwatch.h"
#include "report/noise.h"

namespace vsglbench {

SceneRounds::SceneRounds(std::vector<CaseRun>& runs, bool twin, const Config& config, SceneObserver& observer,
                         std::function<void(CaseRun&)> conclude)
    : runs_(runs), twin_(twin), config_(config), observer_(observer), conclude_(std::move(conclude)) {}

void SceneRounds::run(SceneClocks& clocks, SceneReport* report) {
  uint64_t frames = 0;
  for (const CaseRun& run : runs_) frames += run.frames_left();
  Progress progress(report->name + ": times", frames);
  conclude_finished();
  warm_up();
  while (has_unfinished()) {
    clocks.look();
    every_case([&](CaseRun& run) {
      run.step();
      if (!run.failed()) observer_.timed(run.description().id, run.last_frame());
      progress.advance();
    });
    clocks.look();
    if (clocks.report()) report->clocks = clocks.report();
    conclude_finished();
  }
}

template <class Frame>
void SceneRounds::every_case(const Frame& frame) {
  for (CaseRun& run : runs_)
    if (!run.finished()) frame(run);
}

bool SceneRounds::has_unfinished() const {
  return std::ranges::any_of(runs_, [](const CaseRun& run) { return !run.finished(); });
}

// Frames of every case, in rounds, for as long as a clock takes to rise that an idle device has let fall.
void SceneRounds::warm_up() {
  constexpr double kBusySeconds = 0.3;
  const Stopwatch watch;
  for (uint32_t round = 0; round < config_.warmup || watch.seconds() < kBusySeconds; ++round) {
    if (!has_unfinished()) return;
    every_case([](CaseRun& run) { run.warm_up(); });
  }
}

// Between two rounds: what is finished is told at once, so that no later crash can take it. The case that the
// twin repeats waits for it, so that the two stay a pair whenever a run is cut short.
void SceneRounds::conclude_finished() {
  if (twin_) pair_twin();
  const CaseRun* waiting = original_of_twin();
  for (CaseRun& run : runs_) {
    if (!run.finished() || run.concluded() || &run == waiting) continue;
    if (twin_ && &run == &runs_.back()) {
      conclude_twin();
    } else {
      conclude_(run);
    }
  }
}

// While the twin is measured; else null.
CaseRun* SceneRounds::original_of_twin() {
  if (!twin_ || runs_.back().concluded()) return nullptr;
  const auto original = std::ranges::find_if(runs_, [&](const CaseRun& run) {
    return twin_id(run.description().id) == runs_.back().description().id;
  });
  return &*original;
}

// Nothing when either failed.
void SceneRounds::pair_twin() {
  const CaseRun* original = original_of_twin();
  const CaseRun& twin = runs_.back();
  if (!original || !original->finished() || !twin.finished()) return;
  if (!original->failed() && !twin.failed()) observer_.paired(aa_pair(original->result(), twin.result()));
  conclude_twin();
}

void SceneRounds::conclude_twin() {
  runs_.back().conclude();
  observer_.now({"", "measuring", false});
}

}  // namespace vsglbench
