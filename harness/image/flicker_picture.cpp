#include "image/flicker_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/error.h"
#include "image/canvas.h"
#include "image/error_map.h"
#include "image/theme.h"

namespace vsglbench {
namespace {

constexpr uint32_t kMargin = 20, kGap = 16, kLeastTile = 256, kMostHigh = 1024;
constexpr uint32_t kTitleHeight = 34, kCaptionHeight = 24, kBarHeight = 14, kFoot = 44;
constexpr double kTitle = 20, kText = 15;

bool is_kept(const Mask& mask, size_t i) { return mask.empty() || mask[i] != 0; }

// Signed, of luminance, as a fraction of the mean; `mask` becomes that of the pixels which have one.
Image change_map(const Image& x, const Image& r, const Image& x_before, const Image& r_before,
                 const Mask& mask_before, double mean, Mask* mask) {
  Image out(r.width, r.height);
  Mask kept(r.pixels.size());
  for (size_t i = 0; i < kept.size(); ++i) {
    kept[i] = !x_before.pixels.empty() && is_kept(*mask, i) && is_kept(mask_before, i);
    if (!kept[i]) continue;
    const glm::vec3 change = (x.pixels[i] - x_before.pixels[i]) - (r.pixels[i] - r_before.pixels[i]);
    out.pixels[i] = glm::vec3(static_cast<float>(luminance(change) / mean));
  }
  *mask = std::move(kept);
  return out;
}

// The bar with its range under its ends and middle, as wide as a tile.
void draw_color_bar(Canvas* canvas, glm::dvec2 at, double width, float range) {
  for (double x = 0; x < width; ++x) {
    const auto color = diverging_color(static_cast<float>(2 * (x + 0.5) / width - 1));
    canvas->fill_rectangle({at.x + x, at.y}, {at.x + x + 1, at.y + kBarHeight}, {color});
  }
  static const Font font(kText);
  const auto put = [&](double share, const std::string& text) {
    canvas->text({at.x + share * (width - font.width(text)), at.y + kBarHeight + 4}, text, font,
                 {theme().faint});
  };
  put(0, fmt::format("−{:.4g} %", 100 * range));
  put(0.5, "0");
  put(1, fmt::format("+{:.4g} %", 100 * range));
}

}  // namespace

FlickerPicture::FlickerPicture(FlickerPictureOptions options) : options_(std::move(options)) {
  const Crop& crop = options_.crop;
  if (crop.width == 0 || crop.height == 0 || options_.frames == 0 || !(options_.range > 0) ||
      !(options_.mean_reference > 0)) {
    throw std::logic_error("a flicker picture of nothing");
  }
}

Bitmap FlickerPicture::draw(const Image& x, const Image& r, const Mask& mask) {
  if (x.width != r.width || x.height != r.height || (!mask.empty() && mask.size() != r.pixels.size())) {
    throw fail(ErrorKind::case_failed, "a flicker picture of {}x{} pixels against {}x{} ({} in the mask)",
               x.width, x.height, r.width, r.height, mask.size());
  }
  Image crop_x = crop_image(x, options_.crop), crop_r = crop_image(r, options_.crop);
  Mask crop_kept = crop_mask(mask, r.width, options_.crop), changed = crop_kept;
  const Image change = change_map(crop_x, crop_r, x_, r_, mask_, options_.mean_reference, &changed);

  const uint32_t up =
      std::clamp(kMostHigh / crop_r.height, 1u, (kLeastTile + crop_r.width - 1) / crop_r.width);
  const uint32_t width = std::max(kLeastTile, crop_r.width * up), height = crop_r.height * up;
  const uint32_t tiles_y = kMargin + kTitleHeight + kCaptionHeight;
  Canvas canvas(2 * kMargin + 3 * width + 2 * kGap, tiles_y + height + kFoot + kMargin, theme().paper);
  static const Font title(kTitle), text(kText);
  const double right = kMargin + 3.0 * width + 2 * kGap;
  const std::string number = fmt::format("frame {} of 0 … {}", frame_, options_.frames - 1);
  canvas.text({right - text.width(number), kMargin - 2}, number, text, {theme().faint});
  canvas.text({kMargin, kMargin - 6}, title.fit(options_.title, right - 2 * kMargin - text.width(number)),
              title, {theme().ink});
  const std::pair<const char*, Bitmap> tiles[] = {
      {"test", tone_map(crop_x, options_.exposure)},
      {"reference", tone_map(crop_r, options_.exposure)},
      {"(Δtest − Δreference) / mean", color_error_map(change, options_.range, changed)}};
  uint32_t at = kMargin;
  for (const auto& [caption, tile] : tiles) {
    canvas.text({at, kMargin + kTitleHeight}, text.fit(caption, width), text, {theme().ink});
    canvas.picture(at, tiles_y, enlarge(tile, up, up));
    at += width + kGap;
  }
  draw_color_bar(&canvas, {at - width - kGap, tiles_y + height + 8}, width, options_.range);
  const std::string where =
      fmt::format("pixels ({}, {}) to ({}, {}), ×{}", options_.crop.x, options_.crop.y,
                  options_.crop.x + options_.crop.width - 1, options_.crop.y + options_.crop.height - 1, up);
  canvas.text({kMargin, tiles_y + height + 8}, text.fit(where, 2 * width), text, {theme().faint});
  x_ = std::move(crop_x), r_ = std::move(crop_r), mask_ = std::move(crop_kept);
  ++frame_;
  return canvas.bitmap();
}

}  // namespace vsglbench
