// The tiles of a contact sheet.
#pragma once

#include "image/contact.h"

namespace vsglbench {

// How an image becomes a tile: each pixel repeated `up` times, or the mean of `down`² pixels. The tile's
// place on the sheet may be larger than the image, so that its captions have room.
struct TileSize {
  uint32_t up = 1, down = 1, width = 0, height = 0;
};
TileSize tile_size(const Image& image, uint32_t least_down = 1);

Bitmap image_tile(const ContactSheet& sheet, const Image& image, const TileSize& size);
Bitmap error_tile(const ContactSheet& sheet, Image error, const TileSize& size);
Bitmap text_tile(const std::string& text, const TileSize& size);
// The colour bar with its range, and what the other colours mean.
Bitmap legend_tile(const ContactSheet& sheet, const TileSize& size);

}  // namespace vsglbench
