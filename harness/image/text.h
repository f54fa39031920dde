// Captions: a 5×9 bitmap font for ASCII and a few signs (± × ≤ ≥ · – — … ² µ).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "image/png.h"

namespace vsglbench {

// In font pixels; the last two rows hold descenders only.
inline constexpr uint32_t kGlyphWidth = 5, kGlyphHeight = 9, kGlyphAdvance = 6;

// Width of a line of UTF-8 text in pixels, `scale` pixels a font pixel.
uint32_t text_width(std::string_view utf8, uint32_t scale);

// The text, or its beginning and "…", so that it is at most `width` pixels wide.
std::string fit_text(std::string_view utf8, uint32_t width, uint32_t scale);

// The text broken at spaces into lines of at most `width` pixels; longer words are broken anywhere.
std::vector<std::string> wrap_text(std::string_view utf8, uint32_t width, uint32_t scale);

// Draws with the upper left corner at (x, y); what falls outside the bitmap is cut. A sign that the font
// lacks is drawn as an empty box.
void draw_text(Bitmap& bitmap, uint32_t x, uint32_t y, std::string_view utf8, glm::u8vec3 color,
               uint32_t scale);

}  // namespace vsglbench
