// Frames of an animated picture that shows where an image flickers: the image under test, its reference and
// what one of them changed more than the other, side by side, in a crop of both.
#pragma once

#include <string>

#include "image/crop.h"
#include "image/png.h"

namespace vsglbench {

struct FlickerPictureOptions {
  std::string title;          // such as "colonnade-dynamic  mfis K=1"
  Crop crop;                  // of the frames: worst_crop(meter.sums(), width, side)
  uint32_t frames = 1;        // of the animation
  float exposure = 1;         // one for all frames and both images: auto_exposure of a reference
  double mean_reference = 1;  // what changes are divided by, in W/m²/sr: DerivativeFlicker's
  float range = 0.5f;         // of the colour bar, in mean_reference; 0.5 is 50 %
};

// Pictures of one size for write_apng: title, number of the frame, and three tiles, each pixel repeated by
// the same whole factor so that a crop is 256 pixels wide or more, or nearly 1024 high, with a colour bar
// under the third. The third has ((x_t − x_{t−1}) − (r_t − r_{t−1})) / mean(r) of luminance in
// diverging_color: red where x became brighter beside r, blue where darker; grey where no surface was seen in
// both frames, as in all of the first.
class FlickerPicture {
 public:
  // Throws std::logic_error for an empty crop, no frames, or a range or mean_reference that is not above 0.
  explicit FlickerPicture(FlickerPictureOptions options);
  // The next frame, whole images. Keeps the crop of the last one alone. Throws Error(case_failed) when sizes
  // differ, std::logic_error where the crop reaches out of them. A NaN or Inf is drawn magenta.
  Bitmap draw(const Image& x, const Image& r, const Mask& mask = {});

 private:
  FlickerPictureOptions options_;
  Image x_, r_;  // the last frame's crop
  Mask mask_;
  uint32_t frame_ = 0;
};

}  // namespace vsglbench
