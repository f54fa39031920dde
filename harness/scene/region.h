// The part of a view's frame that it is about, such as where occluded light falls.
#pragma once

#include <optional>

#include "image/crop.h"

namespace vsglbench {

// Shares of the frame's width and height from its upper left corner: 0 <= x0 < x1 <= 1, and so y0 and y1.
struct Region {
  double x0 = 0, y0 = 0, x1 = 1, y1 = 1;
};

// The pixels of a frame whose centres it holds; regions that share an edge share no pixel. Nothing where it
// holds none.
std::optional<Crop> pixels_of(const Region& region, uint32_t width, uint32_t height);

}  // namespace vsglbench
