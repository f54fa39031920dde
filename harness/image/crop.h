// Parts of an image.
#pragma once

#include <vector>

#include "image/metrics.h"

namespace vsglbench {

// A rectangle of pixels whose upper left one is (x, y).
struct Crop {
  uint32_t x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Crop&) const = default;
};

// That part alone. Throws std::logic_error where it is empty or reaches out of the image.
Image crop_image(const Image& image, const Crop& crop);
// Of a mask over `image_width` columns; an empty mask stays empty.
Mask crop_mask(const Mask& mask, uint32_t image_width, const Crop& crop);

// Where the sum of `map` over a square of `side` pixels, or over all of a narrower or lower image, is
// largest; the first in row order of equals. `map` has `width` numbers a row, none below 0: what a pixel's
// flicker sums up to over the frames, as DerivativeFlickerMeter::sums() has it, so that pixels without a
// surface add nothing. Throws std::logic_error where side is 0, the map empty or no whole number of rows.
Crop worst_crop(const std::vector<double>& map, uint32_t width, uint32_t side);

}  // namespace vsglbench
