// The chunks that a PNG file is made of (PNG third edition, 5).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vsglbench {

inline constexpr std::string_view kPngSignature{"\x89PNG\r\n\x1a\n", 8};

struct PngChunk {
  std::string_view type, data;  // type: four letters
};

// The low `bytes` bytes of a number, as PNG has numbers: the highest first.
std::string big_endian(uint32_t value, uint32_t bytes = 4);

// Length, type, data and CRC.
std::string png_chunk(std::string_view type, std::string_view data);

// The chunks of a file that this programme has encoded, in their order; they point into it. Throws
// std::logic_error where it is none.
std::vector<PngChunk> png_chunks(std::string_view file);

}  // namespace vsglbench
