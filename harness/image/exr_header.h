// The attributes in the headers of an EXR file, before a library makes room for them.
#pragma once

#include <cstdint>
#include <span>

namespace vsglbench {

constexpr int kMaxExrSide = 1 << 15;  // pixels

// Throws std::runtime_error, of one line, where an attribute ends behind the file or has another size than
// values of its type: OpenEXR makes room for up to 2 GiB before it finds the file too short, and reads most
// types by their own layout, whatever size the file states. Also where a side is out of range, or the image
// or a tile would take absurdly more memory than the file holds. What is wrong elsewhere is left to the
// library.
void check_exr_headers(std::span<const uint8_t> file);

}  // namespace vsglbench
