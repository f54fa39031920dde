// How much an animation flickers beside its reference. Fed frame by frame; keeps one frame and sums per
// pixel, however many frames there are.
//
// x is the image under test, r its reference, both linear RGB of one size; sums are in double precision.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "image/metrics.h"

namespace vsglbench {

// What reports call "derivative": "flicker-derivative-mean-reference".
const MetricFormula& derivative_flicker_formula();

struct DerivativeFlicker {
  double value = 0;            // mean over all counted pixels of all frames but the first, and over channels
  double p99 = 0;              // 99th percentile over pixels of the mean over the frames where it counts
  uint64_t worst_frame = 0;    // of the largest value in the series; the first frame is 0
  std::vector<double> series;  // mean over pixels and channels; series[i] is of frame i + 1 against frame i
  double mean_reference = 0;   // what all of these were divided by, in W/m²/sr
};

// d_t = |(x_t − x_{t−1}) − (r_t − r_{t−1})|, the mean of three channels, over mean(r): lag and shimmer both
// count; motion that the reference has too, and an error that stays, do not. At frame t a pixel counts where
// the camera sees a surface both in frame t − 1 and in frame t, whatever surface: as camera or objects move,
// pixels come and go. mean(r) is one number for the whole animation, over every pixel of every frame's mask
// (the first one's too) and channels, so that a frame weighs no more for being dark.
class DerivativeFlickerMeter {
 public:
  // The next frame. Throws Error(case_failed) as measure_errors does (sizes, a NaN or an Inf anywhere in an
  // image), for a frame of another size than the first, and where no pixel shows a surface, or none both in
  // this frame and in the one before; a frame that was refused leaves the meter as it was.
  void add(const Image& x, const Image& r, const Mask& mask = {});
  // Of all frames so far. Nothing where the reference is black (its mean is not above 0). Throws
  // Error(case_failed) before the second frame.
  std::optional<DerivativeFlicker> finish() const;

  uint64_t frames() const { return frames_; }
  // Of every pixel, row-major, the sum of d_t over the frames where it counts, in W/m²/sr, not divided by
  // mean(r); 0 where it never does. For worst_crop.
  const std::vector<double>& sums() const { return sums_; }

 private:
  void check(const Image& x, const Image& r, const Mask& mask) const;
  Image x_, r_;  // of the last frame
  Mask mask_;
  std::vector<double> sums_;
  std::vector<uint32_t> counts_;  // frames where a pixel counts
  std::vector<double> frame_means_;
  double total_ = 0, sum_reference_ = 0;  // of d_t over pixels and frames; of r over pixels, frames, channels
  uint64_t pairs_ = 0, pixels_ = 0, frames_ = 0;
};

}  // namespace vsglbench
