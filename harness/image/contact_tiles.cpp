#include "image/contact_tiles.h"

#include <fmt/format.h>

#include <algorithm>

#include "image/canvas.h"
#include "image/error_map.h"
#include "image/theme.h"

namespace vsglbench {
namespace {

constexpr uint32_t kMinTile = 400, kMinHeight = 180, kMaxTile = 960;
constexpr double kSide = 16, kText = 15, kLine = 21;

Image reduce(const Image& image, uint32_t factor) {
  Image out((image.width + factor - 1) / factor, (image.height + factor - 1) / factor);
  for (uint32_t y = 0; y < out.height; ++y) {
    for (uint32_t x = 0; x < out.width; ++x) {
      glm::vec3 sum(0);
      float count = 0;
      for (uint32_t v = y * factor; v < std::min((y + 1) * factor, image.height); ++v) {
        for (uint32_t u = x * factor; u < std::min((x + 1) * factor, image.width); ++u, ++count)
          sum += image.at(u, v);
      }
      out.at(x, y) = sum / count;
    }
  }
  return out;
}

// A reduced pixel shows a surface when any of its pixels does.
Mask reduce(const Mask& mask, uint32_t width, uint32_t height, uint32_t factor) {
  if (mask.empty() || factor == 1) return mask;
  const uint32_t columns = (width + factor - 1) / factor;
  Mask out(size_t(columns) * ((height + factor - 1) / factor), 0);
  for (size_t i = 0; i < mask.size(); ++i) {
    out[i / width / factor * columns + i % width / factor] |= mask[i];
  }
  return out;
}

// 0.2 as "20 %".
std::string percent(float fraction) { return fmt::format("{:.4g} %", 100 * fraction); }

}  // namespace

TileSize tile_size(const Image& image, uint32_t least_down) {
  TileSize t;
  const uint32_t longer = std::max(image.width, image.height);
  if (image.width < kMinTile)
    t.up = std::clamp(kMaxTile / longer, 1u, (kMinTile + image.width - 1) / image.width);
  t.down = std::max((longer + kMaxTile - 1) / kMaxTile, least_down);
  t.width = std::max(kMinTile, (image.width + t.down - 1) / t.down * t.up);
  t.height = std::max(kMinHeight, (image.height + t.down - 1) / t.down * t.up);
  return t;
}

Bitmap image_tile(const ContactSheet& sheet, const Image& image, const TileSize& size) {
  return enlarge(tone_map(size.down > 1 ? reduce(image, size.down) : image, sheet.exposure), size.up,
                 size.up);
}

Bitmap error_tile(const ContactSheet& sheet, Image error, const TileSize& size) {
  const Mask mask = reduce(sheet.mask, error.width, error.height, size.down);
  if (size.down > 1) error = reduce(error, size.down);
  return enlarge(color_error_map(error, sheet.error_range, mask), size.up, size.up);
}

Bitmap text_tile(const std::string& text, const TileSize& size) {
  Canvas tile(size.width, size.height, theme().panel);
  const Font font(kText);
  glm::dvec2 at(kSide);
  for (const auto& line : font.wrap(text, size.width - 2 * kSide)) {
    tile.text(at, line, font, {theme().faint});
    at.y += kLine;
  }
  return tile.bitmap();
}

Bitmap legend_tile(const ContactSheet& sheet, const TileSize& size) {
  Canvas tile(size.width, size.height, theme().panel);
  const Font font(kText);
  const double width = size.width - 2 * kSide;
  double y = 10;
  tile.text({kSide, y}, font.fit("error: 2(x − r) / (|x| + |r|) of luminance", width), font, {theme().ink});
  y += kLine + 2;
  for (double x = 0; x < width; ++x) {
    tile.fill_rectangle({kSide + x, y}, {kSide + x + 1, y + 24},
                        {diverging_color(static_cast<float>(2 * (x + 0.5) / width - 1))});
  }
  y += 28;
  // The range under the bar's ends and middle, the meaning under the range.
  const auto put = [&](double at, const std::string& text, glm::u8vec3 color) {
    tile.text({kSide + at * (width - font.width(text)), y}, text, font, {color});
  };
  put(0, "−" + percent(sheet.error_range), theme().ink);
  put(0.5, "0", theme().ink);
  put(1, "+" + percent(sheet.error_range), theme().ink);
  y += kLine;
  put(0, "too dark", theme().faint);
  put(1, "too bright", theme().faint);
  y += kLine + 2;
  for (const auto& line :
       {fmt::format("clipped: beyond ±{} in the colour of that end", percent(sheet.error_range)),
        std::string("grey: no surface; magenta: NaN or Inf"),
        fmt::format("exposure of all tiles: {:.3g}", sheet.exposure)}) {
    tile.text({kSide, y}, font.fit(line, width), font, {theme().faint});
    y += kLine;
  }
  return tile.bitmap();
}

}  // namespace vsglbench
