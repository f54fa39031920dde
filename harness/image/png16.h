// 16-bit PNG frames, as video metrics take them. ColorVideoVDP (Mantiuk et al. 2024, MIT, the command
// `cvvdp`) reads numbered PNG files of 8 or 16 bits as sRGB, linear 1 being the peak luminance of the display
// that is named to it, and frames from 0 on without a gap.
#pragma once

#include <filesystem>
#include <string>

#include "image/image.h"

namespace vsglbench {

// What the codes 0 … 65535 could not hold.
struct Png16Loss {
  uint64_t above = 0;  // pixels with a channel above the peak
  uint64_t below = 0;  // pixels with a channel below 0
};

// round(65535 · OETF(clamp(x / peak, 0, 1))) per channel with the OETF of sRGB (IEC 61966-2-1); `peak` is the
// radiance in W/m²/sr that becomes linear 1. All frames of an animation, test and reference, take one peak,
// such as 1 / auto_exposure(reference). The file says what its peak is, in a text chunk.
// Throws Error(case_failed) where the image holds a NaN or Inf, Error(output) for an empty image, a peak that
// is not above 0 or not finite, and where the disk refuses; nothing is left half written.
Png16Loss write_png16(const std::filesystem::path& path, const Image& image, float peak);
uint16_t encode_srgb16(double value);  // of clamp(value, 0, 1)

// "0007.png"
std::string frame_file_name(uint32_t frame);

// The command line that compares two folders of such frames, quoted for a POSIX shell:
// cvvdp --test 'test/%04d.png' --ref 'reference/%04d.png' --fps 24 --display standard_fhd
std::string cvvdp_command(const std::filesystem::path& test, const std::filesystem::path& reference,
                          double frames_per_second, const std::string& display = "standard_fhd");

}  // namespace vsglbench
