#include "image/contact.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/error_map.h"
#include "image/text.h"

namespace vsglbench {
namespace {

constexpr glm::u8vec3 kPaper{22, 23, 27}, kPanel{32, 33, 39}, kInk{238, 238, 240}, kFaint{160, 163, 172};
constexpr uint32_t kMargin = 24, kGap = 20, kScale = 2, kLine = (kGlyphHeight + 2) * kScale, kBetween = 6;
constexpr uint32_t kTitleScale = 3, kTitleHeight = (kGlyphHeight + 6) * kTitleScale;
constexpr uint32_t kMinTile = 400, kMinHeight = 180, kMaxTile = 960, kMaxWidth = 2048, kMaxColumns = 4;
constexpr uint32_t kDetailLines = 2;

void fill(Bitmap& bitmap, uint32_t x0, uint32_t y0, uint32_t width, uint32_t height, glm::u8vec3 color) {
  for (uint32_t y = y0; y < std::min(y0 + height, bitmap.height); ++y) {
    for (uint32_t x = x0; x < std::min(x0 + width, bitmap.width); ++x)
      std::copy_n(&color.x, 3, bitmap.at(x, y));
  }
}

void blit(Bitmap& onto, uint32_t x, uint32_t y, const Bitmap& tile) {
  for (uint32_t row = 0; row < tile.height; ++row) {
    std::copy_n(tile.at(0, row), size_t(3) * tile.width, onto.at(x, y + row));
  }
}

// How an image becomes a tile: each pixel repeated `up` times, or the mean of `down`² pixels. The tile's
// place on the sheet may be larger than the image, so that its captions have room.
struct TileSize {
  uint32_t up = 1, down = 1, width = 0, height = 0;
};

TileSize tile_size(uint32_t width, uint32_t height) {
  TileSize t;
  const uint32_t longer = std::max(width, height);
  if (width < kMinTile) t.up = std::clamp(kMaxTile / longer, 1u, (kMinTile + width - 1) / width);
  if (longer > kMaxTile) t.down = (longer + kMaxTile - 1) / kMaxTile;
  t.width = std::max(kMinTile, (width + t.down - 1) / t.down * t.up);
  t.height = std::max(kMinHeight, (height + t.down - 1) / t.down * t.up);
  return t;
}

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

Bitmap enlarge(const Bitmap& bitmap, uint32_t factor) {
  if (factor == 1) return bitmap;
  Bitmap out(bitmap.width * factor, bitmap.height * factor);
  for (uint32_t y = 0; y < out.height; ++y) {
    for (uint32_t x = 0; x < out.width; ++x) std::copy_n(bitmap.at(x / factor, y / factor), 3, out.at(x, y));
  }
  return out;
}

Bitmap image_tile(const ContactSheet& sheet, const Image& image, const TileSize& size) {
  return enlarge(tone_map(size.down > 1 ? reduce(image, size.down) : image, sheet.exposure), size.up);
}

Bitmap error_tile(const ContactSheet& sheet, const ContactEntry& entry, const TileSize& size) {
  const Image& reference = entry.reference ? *entry.reference : sheet.reference;
  Image error = error_map(*entry.image, reference, sheet.mask);
  const Mask mask = reduce(sheet.mask, error.width, error.height, size.down);
  if (size.down > 1) error = reduce(error, size.down);
  return enlarge(color_error_map(error, sheet.error_range, mask), size.up);
}

Bitmap text_tile(const std::string& text, const TileSize& size) {
  Bitmap tile(size.width, size.height);
  fill(tile, 0, 0, tile.width, tile.height, kPanel);
  uint32_t y = kGap;
  for (const auto& line : wrap_text(text, tile.width - 2 * kGap, kScale)) {
    draw_text(tile, kGap, y, line, kFaint, kScale);
    y += kLine;
  }
  return tile;
}

std::string signed_percent(float fraction) { return fmt::format("{:+.4g} %", 100 * fraction); }

// The colour bar with its range, and what the other colours mean.
Bitmap legend_tile(const ContactSheet& sheet, const TileSize& size) {
  Bitmap tile(size.width, size.height);
  fill(tile, 0, 0, tile.width, tile.height, kPanel);
  const uint32_t width = tile.width - 2 * kGap, bar = 2 * kLine;
  uint32_t y = kGap;
  draw_text(tile, kGap, y, fit_text("error: 2(x-r) / (|x|+|r|)", width, kScale), kInk, kScale);
  y += kLine + kBetween;
  for (uint32_t x = 0; x < width; ++x) {
    fill(tile, kGap + x, y, 1, bar, diverging_color(2 * (x + 0.5f) / static_cast<float>(width) - 1));
  }
  y += bar + kBetween;
  // Range under the bar's ends and middle, the meaning under the range.
  const auto put = [&](float at, std::string_view text, uint32_t row, glm::u8vec3 color) {
    const uint32_t room = width - std::min(width, text_width(text, kScale));
    draw_text(tile, kGap + static_cast<uint32_t>(at * static_cast<float>(room)), row, text, color, kScale);
  };
  put(0, signed_percent(-sheet.error_range), y, kInk);
  put(0.5f, "0", y, kInk);
  put(1, signed_percent(sheet.error_range), y, kInk);
  put(0, "too dark", y + kLine, kFaint);
  put(1, "too bright", y + kLine, kFaint);
  y += 2 * kLine + kBetween;
  for (const auto& line : {std::string("grey: no surface"), std::string("magenta: NaN or Inf"),
                           fmt::format("exposure of all tiles: {:.3g}", sheet.exposure)}) {
    draw_text(tile, kGap, y, fit_text(line, width, kScale), kFaint, kScale);
    y += kLine;
  }
  return tile;
}

struct Cell {
  std::string caption, detail;
  Bitmap upper, lower;
};

std::vector<Cell> make_cells(const ContactSheet& sheet, const TileSize& size) {
  std::vector<Cell> cells;
  cells.push_back({"reference", sheet.reference_detail, image_tile(sheet, sheet.reference, size),
                   legend_tile(sheet, size)});
  for (const ContactEntry& entry : sheet.entries) {
    if (!entry.image) {
      cells.push_back({entry.caption, "no image", text_tile(entry.detail, size), text_tile("", size)});
      continue;
    }
    if (entry.image->width != sheet.reference.width || entry.image->height != sheet.reference.height) {
      throw fail(ErrorKind::case_failed, "contact sheet: '{}' is {}x{} but the reference {}x{}",
                 entry.caption, entry.image->width, entry.image->height, sheet.reference.width,
                 sheet.reference.height);
    }
    cells.push_back(
        {entry.caption, entry.detail, image_tile(sheet, *entry.image, size), error_tile(sheet, entry, size)});
  }
  return cells;
}

// Where the text says so it goes on in a new line, else where it has to.
std::vector<std::string> detail_lines(const std::string& text, uint32_t width) {
  const size_t end = text.find('\n');
  if (end == std::string::npos) return wrap_text(text, width, kScale);
  return {fit_text(text.substr(0, end), width, kScale), fit_text(text.substr(end + 1), width, kScale)};
}

// As many columns as fit, then as few as need the same number of rows.
uint32_t column_count(const ContactSheet& sheet, uint32_t tile_width) {
  const auto cells = static_cast<uint32_t>(sheet.entries.size() + 1);
  uint32_t columns = sheet.columns;
  if (columns == 0) columns = std::min(kMaxColumns, (kMaxWidth - 2 * kMargin + kGap) / (tile_width + kGap));
  columns = std::clamp(columns, 1u, cells);
  const uint32_t rows = (cells + columns - 1) / columns;
  return (cells + rows - 1) / rows;
}

}  // namespace

Bitmap contact_sheet(const ContactSheet& sheet) {
  if (sheet.reference.pixels.empty())
    throw fail(ErrorKind::case_failed, "contact sheet: the reference is empty");
  const TileSize size = tile_size(sheet.reference.width, sheet.reference.height);
  const std::vector<Cell> cells = make_cells(sheet, size);
  const uint32_t columns = column_count(sheet, size.width);
  const uint32_t rows = (static_cast<uint32_t>(cells.size()) + columns - 1) / columns;
  const uint32_t head = (1 + kDetailLines) * kLine, cell_height = head + 2 * size.height + kBetween;

  Bitmap out(2 * kMargin + columns * (size.width + kGap) - kGap,
             2 * kMargin + kTitleHeight + rows * (cell_height + kGap) - kGap);
  fill(out, 0, 0, out.width, out.height, kPaper);
  draw_text(out, kMargin, kMargin, fit_text(sheet.title, out.width - 2 * kMargin, kTitleScale), kInk,
            kTitleScale);
  for (uint32_t i = 0; i < cells.size(); ++i) {
    const uint32_t x = kMargin + i % columns * (size.width + kGap);
    const uint32_t y = kMargin + kTitleHeight + i / columns * (cell_height + kGap);
    draw_text(out, x, y, fit_text(cells[i].caption, size.width, kScale), kInk, kScale);
    const std::vector<std::string> detail = detail_lines(cells[i].detail, size.width);
    for (uint32_t line = 0; line < std::min<size_t>(detail.size(), kDetailLines); ++line)
      draw_text(out, x, y + (1 + line) * kLine, detail[line], kFaint, kScale);
    blit(out, x, y + head, cells[i].upper);
    blit(out, x, y + head + size.height + kBetween, cells[i].lower);
  }
  return out;
}

}  // namespace vsglbench
