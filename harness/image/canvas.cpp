#include "image/canvas.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace vsglbench {
namespace {

constexpr double kFar = 1e6;  // cairo's coordinates are fixed-point numbers of 24 bits before the point
constexpr double kHalo = 3;   // pixels wide, half of it outside of the sign

// An image surface and the context that draws on it.
std::shared_ptr<cairo_t> context(uint32_t width, uint32_t height) {
  cairo_surface_t* surface = nullptr;
  if (width > 0 && height > 0 && width <= 32767 && height <= 32767) {
    surface =
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width), static_cast<int>(height));
  }
  if (!surface || cairo_surface_status(surface) != CAIRO_STATUS_SUCCESS) {
    cairo_surface_destroy(surface);
    throw fail(ErrorKind::output, "a picture of {}x{} pixels can't be drawn", width, height);
  }
  std::shared_ptr<cairo_t> cairo(cairo_create(surface), cairo_destroy);
  cairo_surface_destroy(surface);  // the context holds it
  return cairo;
}

// Row `y` of the context's surface: a word a pixel, 0x00RRGGBB.
uint32_t* row(cairo_t* cairo, uint32_t y) {
  cairo_surface_t* surface = cairo_get_target(cairo);
  return reinterpret_cast<uint32_t*>(cairo_image_surface_get_data(surface) +
                                     size_t(y) *
                                         static_cast<size_t>(cairo_image_surface_get_stride(surface)));
}

void circle(cairo_t* cairo, glm::dvec2 centre, double radius) {
  cairo_new_sub_path(cairo);
  cairo_arc(cairo, centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
}

}  // namespace

Canvas::Canvas(uint32_t width, uint32_t height, glm::u8vec3 paper)
    : width_(width), height_(height), cairo_(context(width, height)) {
  fill_rectangle({0, 0}, {width, height}, {paper, 1});
}

Canvas::Canvas(const Bitmap& picture) : Canvas(picture.width, picture.height, glm::u8vec3(0)) {
  this->picture(0, 0, picture);
}

void Canvas::fill(Ink ink) {
  const glm::dvec3 c = glm::dvec3(ink.color) / 255.0;
  cairo_set_source_rgba(cairo_.get(), c.x, c.y, c.z, ink.opacity);
  cairo_fill(cairo_.get());
}

void Canvas::fill_rectangle(glm::dvec2 from, glm::dvec2 to, Ink ink) {
  from = glm::clamp(from, -kFar, kFar), to = glm::clamp(to, -kFar, kFar);
  cairo_rectangle(cairo_.get(), from.x, from.y, to.x - from.x, to.y - from.y);
  fill(ink);
}

void Canvas::outline_rectangle(glm::dvec2 from, glm::dvec2 to, double width, Ink ink) {
  from = glm::clamp(from, -kFar, kFar), to = glm::clamp(to, -kFar, kFar);
  cairo_set_fill_rule(cairo_.get(), CAIRO_FILL_RULE_EVEN_ODD);
  cairo_rectangle(cairo_.get(), from.x, from.y, to.x - from.x, to.y - from.y);
  if (const glm::dvec2 inner = to - from - 2 * width; inner.x > 0 && inner.y > 0)
    cairo_rectangle(cairo_.get(), from.x + width, from.y + width, inner.x, inner.y);
  fill(ink);
  cairo_set_fill_rule(cairo_.get(), CAIRO_FILL_RULE_WINDING);
}

void Canvas::fill_disk(glm::dvec2 centre, double radius, Ink ink) {
  outline_disk(centre, radius, radius, ink);
}

void Canvas::outline_disk(glm::dvec2 centre, double radius, double width, Ink ink) {
  if (glm::any(glm::greaterThan(glm::abs(centre), glm::dvec2(kFar)))) return;
  radius = std::min(radius, kFar);
  cairo_set_fill_rule(cairo_.get(), CAIRO_FILL_RULE_EVEN_ODD);
  circle(cairo_.get(), centre, radius);
  if (width < radius) circle(cairo_.get(), centre, radius - width);
  fill(ink);
  cairo_set_fill_rule(cairo_.get(), CAIRO_FILL_RULE_WINDING);
}

void Canvas::text(glm::dvec2 at, std::string_view text, const Font& font, Ink ink) {
  const glm::dvec3 c = glm::dvec3(ink.color) / 255.0;
  cairo_set_source_rgba(cairo_.get(), c.x, c.y, c.z, ink.opacity);
  cairo_set_scaled_font(cairo_.get(), font.scaled());
  cairo_move_to(cairo_.get(), std::round(at.x), std::round(at.y + font.ascent()));
  cairo_show_text(cairo_.get(), drawable(text).c_str());
  cairo_new_path(cairo_.get());
}

void Canvas::text(glm::dvec2 at, std::string_view text, const Font& font, Ink ink, glm::u8vec3 halo) {
  const glm::dvec3 c = glm::dvec3(halo) / 255.0;
  cairo_set_scaled_font(cairo_.get(), font.scaled());
  cairo_move_to(cairo_.get(), std::round(at.x), std::round(at.y + font.ascent()));
  cairo_text_path(cairo_.get(), drawable(text).c_str());
  cairo_set_source_rgba(cairo_.get(), c.x, c.y, c.z, ink.opacity);
  cairo_set_line_width(cairo_.get(), kHalo);
  cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_stroke(cairo_.get());
  this->text(at, text, font, ink);
}

void Canvas::picture(uint32_t x, uint32_t y, const Bitmap& rgb) {
  cairo_surface_flush(cairo_get_target(cairo_.get()));
  const uint32_t wide = std::min(rgb.width, width_ - std::min(x, width_));
  for (uint32_t v = 0; v < rgb.height && y + v < height_; ++v) {
    uint32_t* to = row(cairo_.get(), y + v) + x;
    for (uint32_t u = 0; u < wide; ++u) {
      const uint8_t* from = rgb.at(u, v);
      to[u] = uint32_t{from[0]} << 16 | uint32_t{from[1]} << 8 | from[2];
    }
  }
  cairo_surface_mark_dirty(cairo_get_target(cairo_.get()));
}

Bitmap Canvas::bitmap() const {
  cairo_surface_flush(cairo_get_target(cairo_.get()));
  Bitmap out(width_, height_);
  for (uint32_t y = 0; y < height_; ++y) {
    const uint32_t* from = row(cairo_.get(), y);
    for (uint32_t x = 0; x < width_; ++x) {
      uint8_t* to = out.at(x, y);
      to[0] = static_cast<uint8_t>(from[x] >> 16), to[1] = static_cast<uint8_t>(from[x] >> 8);
      to[2] = static_cast<uint8_t>(from[x]);
    }
  }
  return out;
}

}  // namespace vsglbench
