// One case while it is measured: its frames, samples and errors so far.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frame/frame.h"
#include "image/metrics.h"
#include "reference/reference.h"
#include "report/report.h"
#include "run/config.h"

namespace vsglbench {

// Where a run's time went, in seconds (report field `wall`).
struct WallTime {
  double total = 0, device = 0, references = 0, visibility = 0, compilation = 0;
  // Wall time beside references, exact visibility and compilation, over the device time of the frames.
  double overhead_ratio() const { return device > 0 ? (total - references - visibility - compilation) / device : 0; }
};

class CaseRun {
 public:
  // A case without a frame yet; `reference` is the one that matches its visibility.
  CaseRun(const Case& description, const Config& config, const ReferenceResult* reference);

  // Compiles its kernels and takes its memory. A failure marks the case.
  void open(Stage& stage, ExactVisibility exact);
  // One untimed frame.
  void warm_up(WallTime* wall);
  // The next frame of the measurement: seeds first, then seed 0 until the stopping rule is met.
  void step(WallTime* wall);
  bool finished() const { return finished_ || failed(); }
  bool failed() const { return result_.status != Status::ok; }
  void fail_with(const std::string& kind, const std::string& message);
  void fail_with(const Error& error);

  // Everything measured, as the report holds it.
  CaseResult result();
  const Case& description() const { return case_; }
  const std::optional<Image>& image() const { return first_image_; }  // of seed 0
  const ReferenceResult* reference() const { return reference_; }
  const Mask& mask() const { return mask_; }  // pixels with a surface for the rasteriser and the reference alike
  const std::vector<double>& span_samples() const { return span_ms_; }
  uint64_t frames_left() const;
  Frame* frame() { return frame_.get(); }

 private:
  bool check(const Image& image);
  void record(const FrameTimes& times);
  void describe_lights();
  bool randomised() const;
  Case case_;
  const Config& config_;
  const ReferenceResult* reference_;
  std::unique_ptr<Frame> frame_;
  CaseResult result_;
  std::vector<std::string> pass_names_;
  std::vector<std::vector<double>> pass_ms_;
  std::vector<double> span_ms_;
  std::vector<SeedResult> seeds_;
  std::optional<Image> first_image_;
  Mask mask_;
  std::optional<StopReason> reason_;
  uint64_t warmups_ = 0;
  double elapsed_s_ = 0;
  bool finished_ = false;
};

// The report's name of an error's kind.
std::string error_kind(const Error& error);

}  // namespace vsglbench
