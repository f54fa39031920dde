// A contact sheet: the reference, every method and its error map side by side, with captions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/metrics.h"
#include "image/png.h"

namespace vsglbench {

// One method's column. Without an image (a failed or skipped case) the tile shows `detail` instead.
struct ContactEntry {
  std::string caption;  // first line, such as "mfis  N=256"
  std::string detail;  // two further lines, such as "SMAPE 12.3 %   bias -0.4 %"; broken at its newline, else
                       // at spaces
  std::optional<Image> image;
  std::optional<Image> reference;  // where the case has another reference than the sheet's
};

struct ContactSheet {
  std::string title;
  std::string reference_detail;  // the same under "reference"
  Image reference;
  Mask mask;              // empty: every pixel
  float exposure = 1;     // one for all tiles: auto_exposure(reference, mask)
  float error_range = 1;  // relative error at the ends of the colour bar; 1 is 100 %
  std::vector<ContactEntry> entries;
  uint32_t columns = 0;  // 0: as many as fit 2048 pixels, at most 4
};

// The first cell holds the reference over a legend with the colour bar, every further cell an image over its
// error map. Images narrower than 400 pixels are enlarged, wider or higher than 960 reduced, by whole
// factors. Throws Error(case_failed) when an image's size differs from the reference's or the reference is
// empty.
Bitmap contact_sheet(const ContactSheet& sheet);

}  // namespace vsglbench
