// 8-bit PNG files and the one tone curve that leads to them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "image/image.h"

namespace vsglbench {

// 8-bit sRGB-encoded pixels, row-major, first row first, `channels` (3: RGB, 4: RGBA) bytes a pixel.
struct Bitmap {
  uint32_t width = 0, height = 0, channels = 3;
  std::vector<uint8_t> bytes;

  Bitmap() = default;
  Bitmap(uint32_t w, uint32_t h, uint32_t c = 3)
      : width(w), height(h), channels(c), bytes(size_t(w) * h * c) {}
  uint8_t* at(uint32_t x, uint32_t y) { return &bytes[(size_t(y) * width + x) * channels]; }
  const uint8_t* at(uint32_t x, uint32_t y) const { return &bytes[(size_t(y) * width + x) * channels]; }
};

// round(255 · OETF(clamp(value, 0, 1))) with the OETF of sRGB (IEC 61966-2-1).
uint8_t encode_srgb(float value);

// encode_srgb(exposure · radiance) per channel; a pixel with a NaN or Inf is drawn magenta (255, 0, 255).
Bitmap tone_map(const Image& image, float exposure);

// Each pixel repeated `across` times in its row, each row `down` times. Throws std::logic_error for 0.
Bitmap enlarge(const Bitmap& bitmap, uint32_t across, uint32_t down);

// A PNG file's bytes. Throws Error(output) when the bitmap is empty.
std::string encode_png(const Bitmap& bitmap);

// Throws Error(output) when the bitmap is empty or the disk refuses; nothing is left half written.
void write_png(const std::filesystem::path& path, const Bitmap& bitmap);
void write_png(const std::filesystem::path& path, const Image& image, float exposure);

// RGB, or RGBA where the file has alpha. Throws Error(output) for a file that is absent, damaged or not PNG.
Bitmap read_png(const std::filesystem::path& path);

}  // namespace vsglbench
