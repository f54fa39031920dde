// An exhibit's pictures on one sheet, and its thumbnail for a page.
#pragma once

#include <string>
#include <vector>

#include "image/png.h"

namespace vsglbench {

struct SheetTile {
  Bitmap picture;  // RGB or RGBA
  std::string caption, detail;
};

// Tiles that stand beside each other, as many as there are; each has the width of the widest picture or of
// `least`, and a picture keeps its shape.
struct SheetRow {
  std::string title;  // above the row; may be empty
  std::vector<SheetTile> tiles;
};

// Rows below each other. A row wraps where it is wider than `most` pixels. Pictures are reduced to
// `tile` pixels of width (smaller ones enlarged by whole factors); 0: as wide as lets the longest row fit,
// 400 at most and 220 at least. Throws Error(output) for no tile.
Bitmap draw_sheet(const std::string& title, const std::vector<SheetRow>& rows, uint32_t tile = 0,
                  uint32_t most = 2048);

// The picture at `width` pixels, by the mean over each pixel's area in linear light; as it is where it is no
// wider.
Bitmap reduce_to_width(const Bitmap& picture, uint32_t width);

// As large as it can be within `bytes` as a PNG, at least 64 pixels wide.
Bitmap thumbnail(const Bitmap& picture, uint64_t bytes);

}  // namespace vsglbench
