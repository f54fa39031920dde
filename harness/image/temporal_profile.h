// One row of pixels over time: what is still is a vertical line, what moves a slanted one, what flickers a
// row of dashes.
#pragma once

#include <string>

#include "image/png.h"

namespace vsglbench {

struct TemporalProfileOptions {
  std::string title;   // such as "colonnade-dynamic  mfis K=1"
  uint32_t row = 0;    // of the frames: crop.y + crop.height / 2 of the worst crop
  float exposure = 1;  // one for all frames and both images: auto_exposure of a reference
};

// The row of test and reference stacked over the frames, time downwards. Keeps one row a frame.
class TemporalProfile {
 public:
  explicit TemporalProfile(TemporalProfileOptions options);
  // The next frame, whole images. Throws Error(case_failed) when sizes differ, from each other or from the
  // first frame's, or the row lies below them.
  void add(const Image& x, const Image& r);

  // As many columns as a frame has, as many rows as there were frames; radiance.
  Image test() const { return stacked(test_); }
  Image reference() const { return stacked(reference_); }
  // Both with one tone curve, pixels enlarged by whole factors to be visible, with axes of pixel x and frame:
  // side by side, or the test above the reference where that would be wider than 2000 pixels. Throws
  // Error(case_failed) before the first frame, Error(output) where it is too large to be drawn. A NaN or Inf
  // is magenta.
  Bitmap draw() const;

 private:
  Image stacked(const std::vector<glm::vec3>& rows) const;
  TemporalProfileOptions options_;
  uint32_t width_ = 0, height_ = 0, frames_ = 0;
  std::vector<glm::vec3> test_, reference_;
};

}  // namespace vsglbench
