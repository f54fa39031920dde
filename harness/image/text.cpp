#include "image/text.h"

#include <algorithm>
#include <array>

namespace vsglbench {
namespace {

// Rows from the top, the leftmost of five pixels in bit 4. Missing rows are empty.
struct Glyph {
  char32_t code;
  std::array<uint8_t, kGlyphHeight> rows;
};

constexpr Glyph kUnknown = {0, {31, 17, 17, 17, 17, 17, 31}};
constexpr Glyph kGlyphs[] = {
    {U' ', {}},
    {U'!', {4, 4, 4, 4, 4, 0, 4}},
    {U'"', {10, 10, 10}},
    {U'#', {10, 10, 31, 10, 31, 10, 10}},
    {U'$', {4, 15, 20, 14, 5, 30, 4}},
    {U'%', {24, 25, 2, 4, 8, 19, 3}},
    {U'&', {12, 18, 20, 8, 21, 18, 13}},
    {U'\'', {4, 4, 8}},
    {U'(', {2, 4, 8, 8, 8, 4, 2}},
    {U')', {8, 4, 2, 2, 2, 4, 8}},
    {U'*', {0, 4, 21, 14, 21, 4, 0}},
    {U'+', {0, 4, 4, 31, 4, 4, 0}},
    {U',', {0, 0, 0, 0, 0, 12, 4, 8}},
    {U'-', {0, 0, 0, 31}},
    {U'.', {0, 0, 0, 0, 0, 12, 12}},
    {U'/', {0, 1, 2, 4, 8, 16, 0}},
    {U'0', {14, 17, 19, 21, 25, 17, 14}},
    {U'1', {4, 12, 4, 4, 4, 4, 14}},
    {U'2', {14, 17, 1, 2, 4, 8, 31}},
    {U'3', {31, 2, 4, 2, 1, 17, 14}},
    {U'4', {2, 6, 10, 18, 31, 2, 2}},
    {U'5', {31, 16, 30, 1, 1, 17, 14}},
    {U'6', {6, 8, 16, 30, 17, 17, 14}},
    {U'7', {31, 1, 2, 4, 8, 8, 8}},
    {U'8', {14, 17, 17, 14, 17, 17, 14}},
    {U'9', {14, 17, 17, 15, 1, 2, 12}},
    {U':', {0, 12, 12, 0, 12, 12}},
    {U';', {0, 12, 12, 0, 12, 4, 8}},
    {U'<', {2, 4, 8, 16, 8, 4, 2}},
    {U'=', {0, 0, 31, 0, 31}},
    {U'>', {8, 4, 2, 1, 2, 4, 8}},
    {U'?', {14, 17, 1, 2, 4, 0, 4}},
    {U'@', {14, 17, 23, 21, 23, 16, 14}},
    {U'A', {14, 17, 17, 31, 17, 17, 17}},
    {U'B', {30, 17, 17, 30, 17, 17, 30}},
    {U'C', {14, 17, 16, 16, 16, 17, 14}},
    {U'D', {28, 18, 17, 17, 17, 18, 28}},
    {U'E', {31, 16, 16, 30, 16, 16, 31}},
    {U'F', {31, 16, 16, 30, 16, 16, 16}},
    {U'G', {14, 17, 16, 23, 17, 17, 15}},
    {U'H', {17, 17, 17, 31, 17, 17, 17}},
    {U'I', {14, 4, 4, 4, 4, 4, 14}},
    {U'J', {7, 2, 2, 2, 2, 18, 12}},
    {U'K', {17, 18, 20, 24, 20, 18, 17}},
    {U'L', {16, 16, 16, 16, 16, 16, 31}},
    {U'M', {17, 27, 21, 21, 17, 17, 17}},
    {U'N', {17, 17, 25, 21, 19, 17, 17}},
    {U'O', {14, 17, 17, 17, 17, 17, 14}},
    {U'P', {30, 17, 17, 30, 16, 16, 16}},
    {U'Q', {14, 17, 17, 17, 21, 18, 13}},
    {U'R', {30, 17, 17, 30, 20, 18, 17}},
    {U'S', {15, 16, 16, 14, 1, 1, 30}},
    {U'T', {31, 4, 4, 4, 4, 4, 4}},
    {U'U', {17, 17, 17, 17, 17, 17, 14}},
    {U'V', {17, 17, 17, 17, 17, 10, 4}},
    {U'W', {17, 17, 17, 21, 21, 21, 10}},
    {U'X', {17, 17, 10, 4, 10, 17, 17}},
    {U'Y', {17, 17, 17, 10, 4, 4, 4}},
    {U'Z', {31, 1, 2, 4, 8, 16, 31}},
    {U'[', {14, 8, 8, 8, 8, 8, 14}},
    {U'\\', {0, 16, 8, 4, 2, 1, 0}},
    {U']', {14, 2, 2, 2, 2, 2, 14}},
    {U'^', {4, 10, 17}},
    {U'_', {0, 0, 0, 0, 0, 0, 0, 31}},
    {U'`', {8, 4, 2}},
    {U'a', {0, 0, 14, 1, 15, 17, 15}},
    {U'b', {16, 16, 22, 25, 17, 17, 30}},
    {U'c', {0, 0, 14, 17, 16, 17, 14}},
    {U'd', {1, 1, 13, 19, 17, 17, 15}},
    {U'e', {0, 0, 14, 17, 31, 16, 14}},
    {U'f', {6, 9, 8, 28, 8, 8, 8}},
    {U'g', {0, 0, 15, 17, 17, 17, 15, 1, 14}},
    {U'h', {16, 16, 22, 25, 17, 17, 17}},
    {U'i', {4, 0, 12, 4, 4, 4, 14}},
    {U'j', {2, 0, 6, 2, 2, 2, 2, 18, 12}},
    {U'k', {16, 16, 18, 20, 24, 20, 18}},
    {U'l', {12, 4, 4, 4, 4, 4, 14}},
    {U'm', {0, 0, 26, 21, 21, 17, 17}},
    {U'n', {0, 0, 22, 25, 17, 17, 17}},
    {U'o', {0, 0, 14, 17, 17, 17, 14}},
    {U'p', {0, 0, 30, 17, 17, 17, 30, 16, 16}},
    {U'q', {0, 0, 15, 17, 17, 17, 15, 1, 1}},
    {U'r', {0, 0, 22, 25, 16, 16, 16}},
    {U's', {0, 0, 15, 16, 14, 1, 30}},
    {U't', {8, 8, 28, 8, 8, 9, 6}},
    {U'u', {0, 0, 17, 17, 17, 19, 13}},
    {U'v', {0, 0, 17, 17, 17, 10, 4}},
    {U'w', {0, 0, 17, 17, 21, 21, 10}},
    {U'x', {0, 0, 17, 10, 4, 10, 17}},
    {U'y', {0, 0, 17, 17, 17, 17, 15, 1, 14}},
    {U'z', {0, 0, 31, 2, 4, 8, 31}},
    {U'{', {2, 4, 4, 8, 4, 4, 2}},
    {U'|', {4, 4, 4, 4, 4, 4, 4}},
    {U'}', {8, 4, 4, 2, 4, 4, 8}},
    {U'~', {0, 0, 8, 21, 2}},
    {0x00B1, {4, 4, 31, 4, 4, 0, 31}},
    {0x00D7, {0, 17, 10, 4, 10, 17}},
    {0x2264, {1, 6, 24, 6, 1, 0, 31}},
    {0x2265, {16, 12, 3, 12, 16, 0, 31}},
    {0x00B7, {0, 0, 0, 12, 12}},
    {0x2013, {0, 0, 0, 31}},
    {0x2014, {0, 0, 0, 31}},
    {0x2026, {0, 0, 0, 0, 0, 0, 21}},
    {0x00B2, {12, 2, 4, 14}},
    {0x00B5, {0, 0, 17, 17, 17, 19, 29, 16, 16}},
};

const Glyph& glyph(char32_t code) {
  const auto it =
      std::find_if(std::begin(kGlyphs), std::end(kGlyphs), [&](const Glyph& g) { return g.code == code; });
  return it == std::end(kGlyphs) ? kUnknown : *it;
}

// Bytes of the UTF-8 sequence that starts with `lead`; 1 for a stray byte.
size_t sequence_length(uint8_t lead) { return lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC0 ? 2 : 1; }

// Each sign as its own piece of the text.
std::vector<std::string_view> signs(std::string_view utf8) {
  std::vector<std::string_view> out;
  for (size_t i = 0; i < utf8.size(); i += out.back().size()) {
    out.push_back(utf8.substr(i, sequence_length(static_cast<uint8_t>(utf8[i]))));
  }
  return out;
}

char32_t decode(std::string_view sign) {
  if (sign.size() == 1) return static_cast<uint8_t>(sign[0]);
  char32_t code = static_cast<uint8_t>(sign[0]) & (0xFF >> (sign.size() + 1));
  for (size_t i = 1; i < sign.size(); ++i) code = code << 6 | (static_cast<uint8_t>(sign[i]) & 0x3F);
  return code;
}

void fill_square(Bitmap& bitmap, uint32_t x0, uint32_t y0, uint32_t side, glm::u8vec3 color) {
  for (uint32_t y = y0; y < std::min(y0 + side, bitmap.height); ++y) {
    for (uint32_t x = x0; x < std::min(x0 + side, bitmap.width); ++x) {
      std::copy_n(&color.x, 3, bitmap.at(x, y));
    }
  }
}

void draw_glyph(Bitmap& bitmap, uint32_t x, uint32_t y, const Glyph& g, glm::u8vec3 color, uint32_t scale) {
  for (uint32_t row = 0; row < kGlyphHeight; ++row) {
    for (uint32_t column = 0; column < kGlyphWidth; ++column) {
      if (!(g.rows[row] >> (kGlyphWidth - 1 - column) & 1)) continue;
      fill_square(bitmap, x + column * scale, y + row * scale, scale, color);
    }
  }
}

}  // namespace

uint32_t text_width(std::string_view utf8, uint32_t scale) {
  const auto count = static_cast<uint32_t>(signs(utf8).size());
  return count == 0 ? 0 : (count * kGlyphAdvance - (kGlyphAdvance - kGlyphWidth)) * scale;
}

std::string fit_text(std::string_view utf8, uint32_t width, uint32_t scale) {
  if (text_width(utf8, scale) <= width) return std::string(utf8);
  std::string out;
  for (const std::string_view sign : signs(utf8)) {
    if (text_width(out + std::string(sign) + "…", scale) > width) break;
    out += sign;
  }
  return out + "…";
}

std::vector<std::string> wrap_text(std::string_view utf8, uint32_t width, uint32_t scale) {
  std::vector<std::string> lines(1);
  size_t last_space = std::string::npos;  // in the current line
  for (const std::string_view sign : signs(utf8)) {
    std::string& line = lines.back();
    if (!line.empty() && text_width(line + std::string(sign), scale) > width) {
      std::string rest;
      if (sign != " " && last_space != std::string::npos) {
        rest = line.substr(last_space + 1);
        line.resize(last_space);
      }
      lines.push_back(rest);
      last_space = std::string::npos;
      if (sign == " ") continue;
    }
    if (sign == " ") last_space = lines.back().size();
    lines.back() += sign;
  }
  return lines;
}

void draw_text(Bitmap& bitmap, uint32_t x, uint32_t y, std::string_view utf8, glm::u8vec3 color,
               uint32_t scale) {
  for (const std::string_view sign : signs(utf8)) {
    draw_glyph(bitmap, x, y, glyph(decode(sign)), color, scale);
    x += kGlyphAdvance * scale;
  }
}

}  // namespace vsglbench
