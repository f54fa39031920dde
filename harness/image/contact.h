// Contact sheets: the reference, every method and its error map side by side, with captions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/metrics.h"
#include "image/png.h"

namespace vsglbench {

// One method's cell. Without an image (a failed or skipped case) the tile shows `detail` instead.
struct ContactEntry {
  std::string caption;  // first line, such as "mfis  N=256"
  std::string detail;   // two further lines, such as "SMAPE 12.3 %"; broken at its newline, else at spaces
  std::optional<Image> image;
  std::optional<Image> reference;  // where the case has another reference than the sheet's
};

struct ContactSheet {
  std::string title;
  std::string reference_detail;  // the same under "reference"
  Image reference;
  Mask mask;              // empty: every pixel
  float exposure = 1;     // one for all tiles: auto_exposure(reference, mask)
  float error_range = 1;  // relative error at the ends of the colour bar, where it is clipped; 1 is 100 %
  std::vector<ContactEntry> entries;
};

// What a page may be: pixels a side, bytes as PNG.
struct PageLimits {
  uint32_t side = 4096;
  uint64_t bytes = 2'000'000;
};

// As few pages as keep within the limits. On each, the first cell holds the reference over a legend with the
// colour bar, every further cell an image over its error map, in the order of the entries. Images narrower
// than 400 pixels are enlarged, wider or higher than 960, or too large for a page, reduced, by whole factors.
// Throws Error(case_failed) when an image's size differs from the reference's or the reference is empty.
std::vector<Bitmap> contact_pages(const ContactSheet& sheet, const PageLimits& limits = {});

// "contact" of one page alone, else "contact-1", "contact-2", ...
std::string page_name(const std::string& stem, size_t page, size_t pages);

}  // namespace vsglbench
