#include "image/crop.h"

#include <algorithm>
#include <stdexcept>

namespace vsglbench {
namespace {

// Whether the crop lies within so many columns and rows.
bool fits(const Crop& crop, uint32_t width, uint32_t height) {
  return crop.width > 0 && crop.height > 0 && uint64_t(crop.x) + crop.width <= width &&
         uint64_t(crop.y) + crop.height <= height;
}

template <class T>
std::vector<T> cut(const std::vector<T>& pixels, uint32_t width, const Crop& crop) {
  std::vector<T> out;
  out.reserve(size_t(crop.width) * crop.height);
  for (uint32_t v = 0; v < crop.height; ++v) {
    const auto from = pixels.begin() + static_cast<ptrdiff_t>(size_t(crop.y + v) * width + crop.x);
    out.insert(out.end(), from, from + crop.width);
  }
  return out;
}

}  // namespace

Image crop_image(const Image& image, const Crop& crop) {
  if (!fits(crop, image.width, image.height)) throw std::logic_error("a crop outside of its image");
  Image out;
  out.width = crop.width;
  out.height = crop.height;
  out.pixels = cut(image.pixels, image.width, crop);
  return out;
}

Mask crop_mask(const Mask& mask, uint32_t image_width, const Crop& crop) {
  if (mask.empty()) return {};
  if (image_width == 0 || !fits(crop, image_width, static_cast<uint32_t>(mask.size() / image_width)))
    throw std::logic_error("a crop outside of its mask");
  return cut(mask, image_width, crop);
}

Crop worst_crop(const std::vector<double>& map, uint32_t width, uint32_t side) {
  if (side == 0 || width == 0 || map.empty() || map.size() % width != 0)
    throw std::logic_error("no crop of this size in this map");
  const auto height = static_cast<uint32_t>(map.size() / width);
  Crop worst{0, 0, std::min(side, width), std::min(side, height)};
  // Of each column, the sum over the rows that a crop covers; as the crop goes down, from scratch, so that
  // nothing is left over from rows that it has passed.
  std::vector<double> columns(width);
  double largest = -1;
  for (uint32_t y = 0; y + worst.height <= height; ++y) {
    std::ranges::fill(columns, 0);
    for (uint32_t v = y; v < y + worst.height; ++v)
      for (uint32_t u = 0; u < width; ++u) columns[u] += map[size_t(v) * width + u];
    for (uint32_t x = 0; x + worst.width <= width; ++x) {
      double sum = 0;
      for (uint32_t u = x; u < x + worst.width; ++u) sum += columns[u];
      if (sum <= largest) continue;
      largest = sum;
      worst.x = x, worst.y = y;
    }
  }
  return worst;
}

}  // namespace vsglbench
