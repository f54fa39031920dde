#include "image/contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "base/error.h"
#include "image/canvas.h"
#include "image/contact_tiles.h"
#include "image/error_map.h"
#include "image/theme.h"

namespace vsglbench {
namespace {

constexpr uint32_t kMargin = 24, kGap = 20, kBetween = 6, kTitleHeight = 44;
constexpr uint32_t kMaxWidth = 2048, kMaxColumns = 4, kDetailLines = 3, kLine = 20, kHead = 4 * kLine + 4;
constexpr double kTitle = 24, kCaption = 17, kDetail = 15;

struct Cell {
  std::string caption, detail;
  Bitmap upper, lower;
};

Cell entry_cell(const ContactSheet& sheet, const ContactEntry& entry, const TileSize& size) {
  if (!entry.image) return {entry.caption, "no image", text_tile(entry.detail, size), text_tile("", size)};
  if (entry.image->width != sheet.reference.width || entry.image->height != sheet.reference.height) {
    throw fail(ErrorKind::case_failed, "contact sheet: '{}' is {}x{} but the reference {}x{}", entry.caption,
               entry.image->width, entry.image->height, sheet.reference.width, sheet.reference.height);
  }
  Image error = error_map(*entry.image, entry.reference ? *entry.reference : sheet.reference, sheet.mask);
  const std::string clipped =
      fmt::format("errors beyond ±{:.4g} % clipped: {:.2g} % of pixels", 100 * sheet.error_range,
                  100 * clipped_share(error, sheet.error_range, sheet.mask));
  return {entry.caption, entry.detail + "\n" + clipped, image_tile(sheet, *entry.image, size),
          error_tile(sheet, std::move(error), size)};
}

// The reference and its legend first.
std::vector<Cell> make_cells(const ContactSheet& sheet, const TileSize& size) {
  std::vector<Cell> cells;
  cells.push_back({"reference", sheet.reference_detail, image_tile(sheet, sheet.reference, size),
                   legend_tile(sheet, size)});
  for (const ContactEntry& entry : sheet.entries) cells.push_back(entry_cell(sheet, entry, size));
  return cells;
}

// Where the text says so it goes on in a new line, else where it has to.
std::vector<std::string> detail_lines(const std::string& text, const Font& font, double width) {
  std::vector<std::string> lines;
  for (size_t at = 0; at <= text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    for (auto& line : font.wrap(text.substr(at, end - at), width)) lines.push_back(std::move(line));
    at = end + 1;
  }
  if (lines.size() > kDetailLines) lines.resize(kDetailLines);
  return lines;
}

// How many cells stand beside each other and below each other.
struct Grid {
  uint32_t columns, rows;
  uint32_t width(const TileSize& size) const { return 2 * kMargin + columns * (size.width + kGap) - kGap; }
  uint32_t height(const TileSize& size) const {
    return 2 * kMargin + kTitleHeight + rows * (kHead + 2 * size.height + kBetween + kGap) - kGap;
  }
};

// As many columns as fit, then as few as need the same number of rows.
Grid grid_of(size_t cells, const TileSize& size, uint32_t side) {
  const uint32_t room = std::min(kMaxWidth, side) - 2 * kMargin + kGap;
  const auto count = static_cast<uint32_t>(cells);
  const uint32_t columns = std::clamp(std::min(kMaxColumns, room / (size.width + kGap)), 1u, count);
  const uint32_t rows = (count + columns - 1) / columns;
  return {(count + rows - 1) / rows, rows};
}

void draw_cell(Canvas* page, const Cell& cell, uint32_t x, uint32_t y, const TileSize& size) {
  static const Font caption(kCaption), detail(kDetail);
  page->text({x, y}, caption.fit(cell.caption, size.width), caption, {theme().ink});
  double line = y + kLine + 2;
  for (const auto& text : detail_lines(cell.detail, detail, size.width)) {
    page->text({x, line}, text, detail, {theme().faint});
    line += kLine;
  }
  page->picture(x, y + kHead, cell.upper);
  page->picture(x, y + kHead + size.height + kBetween, cell.lower);
}

Bitmap draw_page(const std::string& title, const std::string& number, const Cell& reference,
                 std::span<const Cell> entries, const TileSize& size, uint32_t side) {
  const Grid grid = grid_of(entries.size() + 1, size, side);
  Canvas page(grid.width(size), grid.height(size), theme().paper);
  static const Font font(kTitle);
  const double right = grid.width(size) - kMargin - font.width(number);
  page.text({kMargin, kMargin - 4}, font.fit(title, right - 2 * kMargin), font, {theme().ink});
  page.text({right, kMargin - 4}, number, font, {theme().faint});
  for (uint32_t i = 0; i <= entries.size(); ++i) {
    const uint32_t x = kMargin + i % grid.columns * (size.width + kGap);
    const uint32_t y =
        kMargin + kTitleHeight + i / grid.columns * (kHead + 2 * size.height + kBetween + kGap);
    draw_cell(&page, i == 0 ? reference : entries[i - 1], x, y, size);
  }
  return page.bitmap();
}

struct Pages {
  std::vector<Bitmap> bitmaps;
  double excess = 0;  // how many times a limit's size the first page is that passes one; 0: all keep within
};

// The cells on `count` pages, alike in number.
Pages pages_of(const ContactSheet& sheet, const std::vector<Cell>& cells, size_t count, const TileSize& size,
               const PageLimits& limits) {
  const std::span<const Cell> entries(cells.data() + 1, cells.size() - 1);
  Pages out;
  for (size_t i = 0; i < count; ++i) {
    const size_t from = entries.size() * i / count, to = entries.size() * (i + 1) / count;
    const std::string number = count == 1 ? "" : fmt::format("page {} of {}", i + 1, count);
    const Grid grid = grid_of(to - from + 1, size, limits.side);
    out.excess = double(std::max(grid.width(size), grid.height(size))) / limits.side;
    if (out.excess > 1) return out;
    const Bitmap page =
        draw_page(sheet.title, number, cells[0], entries.subspan(from, to - from), size, limits.side);
    out.excess = double(encode_png(page).size()) / double(limits.bytes);
    if (out.excess > 1) return out;
    out.bitmaps.push_back(page);
  }
  out.excess = 0;
  return out;
}

}  // namespace

std::vector<Bitmap> contact_pages(const ContactSheet& sheet, const PageLimits& limits) {
  if (sheet.reference.pixels.empty())
    throw fail(ErrorKind::case_failed, "contact sheet: the reference is empty");
  // Tiles are made smaller only where a page of one entry is too large.
  const uint32_t longer = std::max(sheet.reference.width, sheet.reference.height);
  for (uint32_t down = tile_size(sheet.reference).down; down <= longer; ++down) {
    const TileSize size = tile_size(sheet.reference, down);
    const std::vector<Cell> cells = make_cells(sheet, size);
    const size_t most = std::max<size_t>(1, sheet.entries.size());
    for (size_t count = 1, tried = 0; tried < most;) {
      const Pages pages = pages_of(sheet, cells, count, size, limits);
      if (pages.excess == 0) return pages.bitmaps;
      tried = count;
      // On fewer, each would hold too much.
      count = std::min(most, std::max(count + 1, static_cast<size_t>(0.8 * pages.excess * double(count))));
    }
  }
  throw fail(ErrorKind::case_failed, "contact sheet: no page keeps within {} pixels a side and {} bytes",
             limits.side, limits.bytes);
}

std::string page_name(const std::string& stem, size_t page, size_t pages) {
  return pages == 1 ? stem : fmt::format("{}-{}", stem, page + 1);
}

}  // namespace vsglbench
