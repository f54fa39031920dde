#include "image/draw.h"

#include <algorithm>
#include <cmath>

namespace vsglbench {
namespace {

void blend(Bitmap& bitmap, int x, int y, const Ink& ink, float coverage) {
  uint8_t* pixel = bitmap.at(static_cast<uint32_t>(x), static_cast<uint32_t>(y));
  const float a = ink.opacity * coverage;
  for (int k = 0; k < 3; ++k) {
    const float mixed = (1 - a) * pixel[k] + a * ink.color[k];
    pixel[k] = static_cast<uint8_t>(std::lround(std::clamp(mixed, 0.0f, 255.0f)));
  }
}

int cut(double at, uint32_t size) { return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size))); }

// Share of a pixel at `distance` from the centre that a disk covers, as if its edge were straight.
float disk_share(double distance, double radius) {
  return static_cast<float>(std::clamp(radius - distance + 0.5, 0.0, 1.0));
}

// Blends `share(distance)` of each pixel that a disk may touch.
template <class Share>
void disk(Bitmap& bitmap, glm::dvec2 centre, double radius, const Ink& ink, const Share& share) {
  const int x1 = cut(std::ceil(centre.x + radius + 1), bitmap.width);
  const int y1 = cut(std::ceil(centre.y + radius + 1), bitmap.height);
  for (int y = cut(std::floor(centre.y - radius - 1), bitmap.height); y < y1; ++y) {
    for (int x = cut(std::floor(centre.x - radius - 1), bitmap.width); x < x1; ++x) {
      const float s = share(std::hypot(x + 0.5 - centre.x, y + 0.5 - centre.y));
      if (s > 0) blend(bitmap, x, y, ink, s);
    }
  }
}

}  // namespace

void fill_rectangle(Bitmap& bitmap, glm::ivec2 from, glm::ivec2 to, Ink ink) {
  const int x1 = cut(to.x, bitmap.width), y1 = cut(to.y, bitmap.height);
  for (int y = cut(from.y, bitmap.height); y < y1; ++y) {
    for (int x = cut(from.x, bitmap.width); x < x1; ++x) blend(bitmap, x, y, ink, 1);
  }
}

void outline_rectangle(Bitmap& bitmap, glm::ivec2 from, glm::ivec2 to, Ink ink) {
  if (to.x - from.x <= 2 || to.y - from.y <= 2) return fill_rectangle(bitmap, from, to, ink);
  fill_rectangle(bitmap, from, {to.x, from.y + 1}, ink);
  fill_rectangle(bitmap, {from.x, to.y - 1}, to, ink);
  fill_rectangle(bitmap, {from.x, from.y + 1}, {from.x + 1, to.y - 1}, ink);
  fill_rectangle(bitmap, {to.x - 1, from.y + 1}, {to.x, to.y - 1}, ink);
}

void fill_disk(Bitmap& bitmap, glm::dvec2 centre, double radius, Ink ink) {
  disk(bitmap, centre, radius, ink, [&](double d) { return disk_share(d, radius); });
}

void outline_disk(Bitmap& bitmap, glm::dvec2 centre, double radius, double width, Ink ink) {
  const double inner = std::max(radius - width, -1.0);
  disk(bitmap, centre, radius, ink, [&](double d) { return disk_share(d, radius) - disk_share(d, inner); });
}

}  // namespace vsglbench
