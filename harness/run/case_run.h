// One case while it is measured: its frames, samples and errors so far.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frame/frame.h"
#include "image/flip.h"
#include "image/metrics.h"
#include "reference/reference.h"
#include "report/report.h"
#include "run/activity.h"
#include "run/config.h"

namespace vsglbench {

// What a case is measured with; all of it outlives the case.
struct CaseInput {
  const ReferenceResult* reference = nullptr;     // that matches its visibility, for whole frames
  const ReferenceInfo* reference_info = nullptr;  // of that reference
  const KeptPdfs* pdfs = nullptr;                 // for generation alone
  ExactVisibility exact;
};

class CaseRun {
 public:
  // A case without a frame yet. `config` and `wall` outlive it; times are added to `wall`. `announce` is
  // called at the start of every action that runs the method's code.
  CaseRun(const Case& description, const Config& config, WallTime* wall, Announce announce = {});

  // Compiles its kernels and takes its memory. Like warm_up() and step() it throws Error(device_lost) only,
  // for a device that is lost to all: whatever else goes wrong fails the case, and only this one.
  void open(Stage& stage, CaseInput input);
  // One untimed frame.
  void warm_up();
  // The next frame of the measurement: the seeds first, then seed 0 until the stopping rule is met.
  // Generation alone is measured with seed 0.
  void step();
  // Destroys the method, its frame and the images; the numbers stay.
  void conclude();
  bool concluded() const { return concluded_; }
  // For work of the harness amid an action, such as tracing rays: the time limit rests meanwhile.
  template <class Work>
  auto rest_limit(const Work& work) {
    announce(false);
    auto result = work();
    announce(true);
    return result;
  }

  bool finished() const { return finished_ || failed(); }
  bool failed() const { return result_.status != Status::ok; }
  uint64_t frames_left() const;  // at least
  // The first failure stays; what was measured until then is kept. Kind asset_missing skips the case.
  void fail_with(ErrorKind kind, const std::string& message);

  // Everything measured so far, as the report holds it.
  CaseResult result() const;
  const Case& description() const { return case_; }
  const std::optional<Image>& image() const { return first_image_; }          // of seed 0
  const std::optional<Image>& cancellation() const { return cancellation_; }  // ShadingNotes, of seed 0
  const ReferenceResult* reference() const { return input_.reference; }
  const Mask& mask() const {
    return mask_;
  }                                        // pixels with a surface for the rasteriser and the reference alike
  Frame* frame() { return frame_.get(); }  // null before open() and after a failure

 private:
  template <class Action>
  void attempt(const std::string& name, const Action& action);
  void announce(bool limited) const;
  uint32_t seeds() const;  // to be scored
  FrameTimes render(uint32_t seed, bool watched = false);
  void score(uint32_t seed);
  void make_mask();
  void measure_look(const Image& image, uint32_t seed, Errors* errors);
  void check_health_of(const Image& image);
  void check_memory();
  void check_lights();
  double check_flux();
  void check_passes();
  void record(const FrameTimes& times);
  void describe_lights();
  void describe_shading();

  Case case_;
  const Config& config_;
  WallTime* wall_;
  Announce announce_;
  std::string action_;  // announced last
  CaseInput input_;
  std::unique_ptr<Frame> frame_;
  CaseResult result_;  // but for what result() makes of the samples below
  std::vector<PassId> passes_;
  std::vector<std::vector<double>> pass_ms_;  // of each pass, one a frame
  std::vector<double> span_ms_;
  std::vector<double> rays_ms_;  // of exact visibility on the host, in each frame that traced any
  std::vector<SeedResult> seeds_;
  std::vector<double> flux_;  // of each light set looked at
  std::optional<double> texel_power_;
  std::optional<ErrorQuantiles> quantiles_;
  std::optional<FlipExposures> flip_exposures_;  // chosen with the first seed
  std::unique_ptr<FlipReference> flip_;          // for further seeds
  std::optional<Image> first_image_, cancellation_;
  Mask mask_;
  std::optional<StopReason> reason_;
  uint64_t warmups_ = 0;
  double elapsed_s_ = 0;
  bool rendered_ = false, finished_ = false, concluded_ = false;
};

// Calls `action`; hands whatever it throws to `failed(kind, message)`, the message on one line. Only
// Error(device_lost) goes on to the caller: a lost device ends more than what `action` was about.
template <class Action, class Failed>
void guarded(const Action& action, const Failed& failed);

// "a\nb" as "a b".
std::string one_line(std::string text);

template <class Action, class Failed>
void guarded(const Action& action, const Failed& failed) {
  try {
    action();
  } catch (const Error& e) {
    if (e.kind() == ErrorKind::device_lost) throw;
    failed(e.kind(), one_line(e.what()));
  } catch (const std::bad_alloc&) {
    failed(ErrorKind::case_failed, "out of memory; use a smaller frame, RSM or number of lights");
  } catch (const std::exception& e) {
    failed(ErrorKind::internal, one_line(e.what()));
  }
}

}  // namespace vsglbench
