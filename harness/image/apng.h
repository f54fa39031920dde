// Animated PNG files (PNG third edition, 11.3.3.6: acTL, fcTL, fdAT).
#pragma once

#include <filesystem>
#include <functional>

#include "image/labelled.h"

namespace vsglbench {

// Frames of one size and one number of channels, each shown for 1 / frames_per_second, again and again: to a
// hundredth of a frame a second within 0.01 … 655, else to a second or to a frame a second; what is shown
// longer than 65535 s, or shorter than 1/65535 s, is shown for that, as the format can hold no other. `frame`
// is asked for frames 0, 1, … frames − 1, once each, and no more than one is held. What can't show an
// animation shows frame 0. The labels are texts of the file.
//
// Throws Error(output) when there are no frames, one is empty or unlike the first, frames_per_second is not
// above 0 and finite, or the disk refuses; and what `frame` throws, as it is. Nothing is left half written.
void write_apng(const std::filesystem::path& path, uint32_t frames, double frames_per_second,
                const std::function<Bitmap(uint32_t)>& frame, const Labels& labels = {});

}  // namespace vsglbench
