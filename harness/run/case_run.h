// One case while it is measured: its frames, samples and errors so far. First it is looked at: every seed is
// rendered and compared with the reference. Then it is timed, and nothing else is done between its frames.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frame/frame.h"
#include "image/metrics.h"
#include "reference/reference.h"
#include "report/report.h"
#include "run/activity.h"
#include "run/case_progress.h"
#include "run/config.h"
#include "run/scoring.h"
#include "scene/region.h"

namespace vsglbench {

// What a case is measured with; all of it outlives the case.
struct CaseInput {
  const ReferenceResult* reference = nullptr;     // that matches its visibility, for whole frames
  const ReferenceInfo* reference_info = nullptr;  // of that reference
  FlipKeeper* flip = nullptr;                     // of the scene's cases
  std::optional<Region> region;                   // of the view
  const KeptPdfs* pdfs = nullptr;                 // for generation alone
  ExactVisibility exact;
};

class CaseRun {
 public:
  // A case without a frame yet. `config` and `wall` outlive it; times are added to `wall`. `announce` is
  // called at the start of every action that runs the method's code. `progress`: what another process has
  // done of it, which is not done again.
  CaseRun(const Case& description, const Config& config, WallTime* wall, Announce announce = {},
          CaseProgress progress = {});

  // Compiles its kernels and takes its memory. Like warm_up() and step() it throws Error(device_lost) only,
  // for a device that is lost to all: whatever else goes wrong fails the case, and only this one.
  void open(Stage& stage, CaseInput input);
  // Renders the seeds, the last one first, and checks what can be checked of each on the device; their errors
  // are measured meanwhile. Generation alone renders no image: its lights of seed 0 are looked at.
  void look();
  // Waits for the errors.
  void settle();
  // The view has a region, and no pixel of it counts; once the images are looked at by this process.
  bool misses_region() const { return input_.region && scoring_ && !scoring_->has_region(); }
  bool scored() const { return scored_; }  // looked at and settled, by this process or by another
  // Everything but times, once it is settled; the images are the caller's to add.
  ScoredCase score() const { return {result_, rays_ms_}; }
  void add_images(const std::map<std::string, std::string>& images) {
    for (const auto& [name, path] : images) result_.images[name] = path;
  }
  // Takes over what set_frame() moved, after Stage::follow().
  void follow(const Moved& moved);
  // A frame of the scene's pose, checked as those of look(), with `reference`, of that pose; nothing where
  // the case fails.
  struct Look {
    Image image;
    Mask mask;  // as mask()
  };
  // `carried`: as Frame::render_in_motion().
  std::optional<Look> look_in_motion(uint32_t frame, uint32_t seed, const ReferenceResult& reference,
                                     Carried* carried);
  bool has_temporal() const { return result_.temporal.has_value(); }
  void add_temporal(Temporal temporal) { result_.temporal = std::move(temporal); }
  uint32_t seeds() const;  // to be looked at
  // One untimed frame of seed 0.
  void warm_up();
  // The next timed frame, of seed 0, until the stopping rule is met.
  void step();
  const FrameTimes& last_frame() const { return last_; }  // timed
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
  // The case is measured to its end, and fails then.
  void fail_in_the_end(ErrorKind kind, const std::string& message);

  // Everything measured so far, as the report holds it.
  CaseResult result() const;
  const Case& description() const { return case_; }
  const std::optional<Image>& image() const { return first_image_; }  // of seed 0, once it is looked at
  const std::optional<Image>& cancellation() const { return cancellation_; }  // ShadingNotes, of seed 0
  const ReferenceResult* reference() const { return input_.reference; }
  // Pixels with a surface for the rasteriser and the reference alike.
  const Mask& mask() const { return scoring_->mask(); }
  Frame* frame() { return frame_.get(); }  // null before open() and after a failure

 private:
  template <class Action>
  void attempt(const std::string& name, const Action& action);
  void announce(bool limited) const;
  FrameTimes render(uint32_t seed, bool watched = false);
  template <class Render>
  FrameTimes run_frame(bool watched, const Render& render);
  void look_at(uint32_t seed);
  void start_scoring();
  Mask make_mask(const ReferenceResult& reference) const;
  void check_health_of(const Image& image);
  void check_memory();
  void check_lights();
  double check_flux();
  void check_passes();
  void record(const FrameTimes& times, double elapsed_s);
  SeedResult seed_of(uint32_t seed) const;
  void describe_lights(const std::optional<Coverage>& coverage);
  void describe_shading(ShadingNotes notes);

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
  FrameTimes last_;
  std::vector<double> flux_;  // of each light set looked at, the last seed's first
  std::optional<double> texel_power_;
  std::unique_ptr<Scoring> scoring_;  // null before the first image
  std::optional<Image> first_image_, cancellation_;
  std::optional<StopReason> reason_;
  uint64_t warmups_ = 0;
  double elapsed_s_ = 0;
  bool rendered_ = false, scored_ = false, finished_ = false, concluded_ = false;
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
