#include "papers/sheet.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "image/canvas.h"
#include "image/theme.h"

namespace vsglbench {
namespace {

constexpr uint32_t kMargin = 20, kGap = 14, kLine = 19, kTitleHeight = 40, kRowTitle = 28, kDetailLines = 2;
constexpr uint32_t kNarrowest = 64, kLeastTile = 220, kMostTile = 400;

// The sRGB curve backwards.
float linear(uint8_t value) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> out{};
    for (size_t i = 0; i < out.size(); ++i) {
      const double v = static_cast<double>(i) / 255;
      out[i] = static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    }
    return out;
  }();
  return table[value];
}

Bitmap without_alpha(const Bitmap& picture) {
  if (picture.channels == 3) return picture;
  Bitmap out(picture.width, picture.height);
  for (uint32_t y = 0; y < picture.height; ++y) {
    for (uint32_t x = 0; x < picture.width; ++x) std::copy_n(picture.at(x, y), 3, out.at(x, y));
  }
  return out;
}

// Parts of the source pixels that one target pixel covers on an axis.
struct Share {
  uint32_t pixel;
  double weight;
};
std::vector<Share> shares(uint32_t target, double scale, uint32_t size) {
  std::vector<Share> out;
  const double from = target * scale, to = std::min<double>((target + 1) * scale, size);
  for (auto p = static_cast<uint32_t>(from); p < to; ++p)
    out.push_back({p, (std::min<double>(p + 1, to) - std::max<double>(p, from)) / (to - from)});
  return out;
}

// As wide as a tile is, by whole factors where it must be larger.
Bitmap fitted(const Bitmap& picture, uint32_t width) {
  const Bitmap rgb = without_alpha(picture);
  if (rgb.width > width) return reduce_to_width(rgb, width);
  const uint32_t factor = std::max(1u, width / rgb.width);
  return factor > 1 ? enlarge(rgb, factor, factor) : rgb;
}

struct Block {
  std::string title;
  std::vector<SheetTile> tiles;  // pictures fitted
  uint32_t height = 0;           // of its highest picture
};

std::vector<Block> blocks_of(const std::vector<SheetRow>& rows, uint32_t tile, uint32_t most) {
  const uint32_t across = std::max(1u, (most - 2 * kMargin + kGap) / (tile + kGap));
  std::vector<Block> out;
  for (const SheetRow& row : rows) {
    for (size_t i = 0; i < row.tiles.size(); ++i) {
      if (i % across == 0) out.push_back({i == 0 ? row.title : "", {}, 0});
      SheetTile fit = row.tiles[i];
      fit.picture = fitted(fit.picture, tile);
      out.back().height = std::max(out.back().height, fit.picture.height);
      out.back().tiles.push_back(std::move(fit));
    }
  }
  return out;
}

uint32_t height_of(const Block& b) {
  return (b.title.empty() ? 0 : kRowTitle) + (1 + kDetailLines) * kLine + b.height + kGap;
}

void draw(Canvas* page, const Block& block, uint32_t y, uint32_t tile) {
  static const Font title(17), caption(15), detail(13);
  if (!block.title.empty()) {
    page->text({kMargin, y}, block.title, title, {theme().ink});
    y += kRowTitle;
  }
  for (size_t i = 0; i < block.tiles.size(); ++i) {
    const auto x = static_cast<uint32_t>(kMargin + i * (tile + kGap));
    const SheetTile& t = block.tiles[i];
    page->text({x, y}, caption.fit(t.caption, tile), caption, {theme().ink});
    auto lines = detail.wrap(t.detail, tile);
    lines.resize(std::min<size_t>(lines.size(), kDetailLines));
    for (size_t l = 0; l < lines.size(); ++l)
      page->text({x, y + (l + 1) * kLine}, lines[l], detail, {theme().faint});
    page->picture(x, y + (1 + kDetailLines) * kLine, t.picture);
  }
}

}  // namespace

Bitmap reduce_to_width(const Bitmap& picture, uint32_t width) {
  if (picture.width <= width) return picture;
  const double scale = static_cast<double>(picture.width) / width;
  const auto height = std::max<uint32_t>(1, static_cast<uint32_t>(std::lround(picture.height / scale)));
  const double scale_y = static_cast<double>(picture.height) / height;
  Bitmap out(width, height, picture.channels);
  std::vector<std::vector<Share>> across(width);
  for (uint32_t x = 0; x < width; ++x) across[x] = shares(x, scale, picture.width);
  for (uint32_t y = 0; y < height; ++y) {
    const auto down = shares(y, scale_y, picture.height);
    for (uint32_t x = 0; x < width; ++x) {
      for (uint32_t c = 0; c < picture.channels; ++c) {
        double sum = 0;
        for (const Share& v : down) {
          for (const Share& h : across[x])
            sum +=
                v.weight * h.weight *
                (c == 3 ? picture.at(h.pixel, v.pixel)[c] / 255.0 : linear(picture.at(h.pixel, v.pixel)[c]));
        }
        out.at(x, y)[c] =
            c == 3 ? static_cast<uint8_t>(std::lround(255 * sum)) : encode_srgb(static_cast<float>(sum));
      }
    }
  }
  return out;
}

Bitmap thumbnail(const Bitmap& picture, uint64_t bytes) {
  Bitmap out = picture;
  for (uint32_t width = picture.width; encode_png(out).size() > bytes && width > kNarrowest;) {
    // Bytes go with the area; a little less, so that few tries do.
    const double over = static_cast<double>(encode_png(out).size()) / static_cast<double>(bytes);
    const auto next = static_cast<uint32_t>(width * std::clamp(0.97 / std::sqrt(over), 0.3, 0.95));
    width = std::max(kNarrowest, next);
    out = reduce_to_width(picture, width);
  }
  return out;
}

Bitmap draw_sheet(const std::string& title, const std::vector<SheetRow>& rows, uint32_t tile, uint32_t most) {
  if (tile == 0) {
    size_t longest = 1;
    for (const SheetRow& row : rows) longest = std::max(longest, row.tiles.size());
    const auto room = static_cast<uint32_t>((most - 2 * kMargin + kGap) / longest);
    tile = std::clamp(room > kGap ? room - kGap : 0, kLeastTile, kMostTile);
  }
  const std::vector<Block> blocks = blocks_of(rows, tile, most);
  if (blocks.empty()) throw fail(ErrorKind::output, "{}: there is no picture for its sheet", title);
  size_t across = 1;
  uint32_t height = kMargin + kTitleHeight;
  for (const Block& b : blocks) {
    across = std::max(across, b.tiles.size());
    height += height_of(b);
  }
  const auto width = static_cast<uint32_t>(2 * kMargin + across * (tile + kGap) - kGap);
  Canvas page(width, height, theme().paper);
  static const Font font(21);
  page.text({kMargin, kMargin - 6}, font.fit(title, width - 2.0 * kMargin), font, {theme().ink});
  uint32_t y = kMargin + kTitleHeight;
  for (const Block& b : blocks) {
    draw(&page, b, y, tile);
    y += height_of(b);
  }
  return page.bitmap();
}

}  // namespace vsglbench
