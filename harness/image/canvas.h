// A picture drawn with cairo: marks, text, other pictures. Positions are in pixels from the upper left
// corner, a pixel's centre at .5; edges are antialiased, and what falls outside is cut.
#pragma once

#include <memory>
#include <string_view>

#include "image/font.h"
#include "image/png.h"

struct _cairo;

namespace vsglbench {

struct Ink {
  glm::u8vec3 color{255};
  float opacity = 1;
};

class Canvas {
 public:
  // Throws Error(output) for a size that cairo does not take: 0, or above 32767.
  Canvas(uint32_t width, uint32_t height, glm::u8vec3 paper);
  explicit Canvas(const Bitmap& picture);  // RGB

  void fill_rectangle(glm::dvec2 from, glm::dvec2 to, Ink ink);
  // Its outermost pixels, `width` of them, inside of its edge.
  void outline_rectangle(glm::dvec2 from, glm::dvec2 to, double width, Ink ink);
  void fill_disk(glm::dvec2 centre, double radius, Ink ink);
  // A ring of `width` pixels inside of the disk's edge.
  void outline_disk(glm::dvec2 centre, double radius, double width, Ink ink);
  // One line whose box has its upper left corner at `at`.
  void text(glm::dvec2 at, std::string_view text, const Font& font, Ink ink);
  // The same with a rim of `halo` around every sign, to be read on anything.
  void text(glm::dvec2 at, std::string_view text, const Font& font, Ink ink, glm::u8vec3 halo);
  void picture(uint32_t x, uint32_t y, const Bitmap& rgb);

  Bitmap bitmap() const;  // RGB

 private:
  void fill(Ink ink);
  uint32_t width_, height_;
  std::shared_ptr<_cairo> cairo_;
};

}  // namespace vsglbench
