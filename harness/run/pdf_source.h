// The key `pdf`: what the RSM's lights are drawn by where generation alone is measured [MFIS16 Tab. 2].
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json.h"
#include "run/sweep.h"

namespace vsglbench {

struct PdfSource {
  enum class Kind {
    own,     // the lights that each method itself makes on the G-buffer, with its parameters
    flux,    // nobody's lights: the power that a texel reflects
    method,  // the lights that one method makes for all, with its defaults
    image,   // luminance of a picture
  };
  Kind kind = Kind::method;
  std::string name;  // of the method, or the picture's path; else empty
};

// Throws Error(config), one line, for what is neither "own", "flux", the name of a method that draws lights,
// nor an image file (.exr, .png, from where the command runs) that exists.
PdfSource pdf_source(const std::string& text);

// Luminance of a picture at every texel of an RSM of `side` texels a side, row by row, the largest 1: the
// mean over the texel's area, and on an axis where the picture has fewer pixels than the RSM texels the
// nearest. Its first row is that of the RSM as rsm.png shows it. PNG is decoded from sRGB; alpha does not
// count. Throws Error(config), one line, for a file that is absent, damaged, has a NaN, an Inf or a luminance
// below 0, or is black.
std::vector<float> read_pdf_image(const std::filesystem::path& path, uint32_t side);

// What a config says of the PDFs of its cases once each is resolved: `pdfs_made_by`, in words, and
// `pdf_images`, the hash of every picture that they are drawn by, by its path. Reads them all: throws as
// read_pdf_image().
Json describe_pdfs(const std::vector<Case>& cases);

}  // namespace vsglbench
