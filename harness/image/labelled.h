// EXR and PNG files that say what they show.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "image/png.h"

namespace vsglbench {

// By name: of an EXR the text attributes of its header, of a PNG its texts (tEXt, or iTXt where they are not
// ASCII). A name has 1 to 79 printable characters of ASCII.
using Labels = std::map<std::string, std::string>;

// What every image of radiance has, beside what is said of its case.
Labels radiance_labels();

// As write_exr with a channel A, which the labels explain.
void write_exr(const std::filesystem::path& path, const Image& image, const std::vector<uint8_t>& coverage,
               const Labels& labels);
void write_png(const std::filesystem::path& path, const Bitmap& bitmap, const Labels& labels);

// A PNG that encode_png made, with texts; and the texts of any such. Throws std::logic_error for a name that
// can't be one.
std::string with_labels(const std::string& png, const Labels& labels);
Labels png_labels(std::string_view png);

}  // namespace vsglbench
