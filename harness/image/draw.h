// Marks on a bitmap, each blended over what is there with an opacity of 0 to 1; what falls outside is cut.
#pragma once

#include "image/png.h"

namespace vsglbench {

struct Ink {
  glm::u8vec3 color{255};
  float opacity = 1;
};

// Pixels [x0, x1) × [y0, y1).
void fill_rectangle(Bitmap& bitmap, glm::ivec2 from, glm::ivec2 to, Ink ink);
// The outermost pixels of that rectangle, each drawn once.
void outline_rectangle(Bitmap& bitmap, glm::ivec2 from, glm::ivec2 to, Ink ink);

// A disk round `centre`, in pixels (a pixel's centre is at .5), with antialiased edge; the outline is a ring
// of `width` pixels inside of that edge.
void fill_disk(Bitmap& bitmap, glm::dvec2 centre, double radius, Ink ink);
void outline_disk(Bitmap& bitmap, glm::dvec2 centre, double radius, double width, Ink ink);

}  // namespace vsglbench
