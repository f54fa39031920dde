// A picture of lights between its captions.
#pragma once

#include <string>
#include <vector>

#include "image/png.h"

namespace vsglbench {

// Pixels around a picture and between its parts, and from one line of text to the next.
inline constexpr uint32_t kPictureMargin = 12, kPictureLine = 22;
inline constexpr double kPictureText = 16;

// The picture between two blocks of text, the lower one fainter, with a margin around all.
Bitmap framed(const Bitmap& picture, const std::vector<std::string>& above,
              const std::vector<std::string>& below);

}  // namespace vsglbench
