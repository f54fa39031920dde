// OpenEXR files: 32-bit float channels, ZIP compression, written whole or not at all.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "image/image.h"

namespace vsglbench {

// Several images of one size in one file. A colour layer "half0" is stored as the channels half0.R, half0.G
// and half0.B (the layer "" as R, G, B); a scalar layer "variance" as the channel variance, row-major.
// On reading, any complete R, G, B triple becomes a colour layer and every other channel a scalar one.
struct ExrLayers {
  uint32_t width = 0, height = 0;
  std::map<std::string, Image> colors;
  std::map<std::string, std::vector<float>> scalars;
  std::map<std::string, std::string> attributes;  // text in the header, such as a content hash
};

// Throws Error(output) when the image is empty, a layer's size differs from the file's, or the disk refuses.
void write_exr(const std::filesystem::path& path, const Image& image);
// With channel A: 1 where `coverage` is not 0 (the pixel counts in the errors), 0 elsewhere; 1 everywhere for
// an empty one. Colours are not multiplied by it.
void write_exr(const std::filesystem::path& path, const Image& image, const std::vector<uint8_t>& coverage);
void write_exr(const std::filesystem::path& path, const ExrLayers& layers);

// The bytes of a file with half floats, ZIP compression: for a page, of less than half the size. A value
// beyond 65504 becomes that. With a channel A where `alpha` is not empty, one value a pixel. Throws
// std::runtime_error for an empty image.
std::string encode_half_exr(const Image& image, const std::vector<float>& alpha = {});

// Throws Error(output), naming the file and the reason, when it is absent, truncated, damaged or not EXR.
// read_exr needs the channels R, G and B, and leaves others alone; half and integer channels are widened to
// float.
Image read_exr(const std::filesystem::path& path);
ExrLayers read_exr_layers(const std::filesystem::path& path);

}  // namespace vsglbench
