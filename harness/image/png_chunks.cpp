#include "image/png_chunks.h"

#include <zlib.h>

#include <stdexcept>

namespace vsglbench {
namespace {

uint32_t read_big_endian(std::string_view bytes) {
  uint32_t value = 0;
  for (const char c : bytes) value = value << 8 | static_cast<uint8_t>(c);
  return value;
}

}  // namespace

std::string big_endian(uint32_t value, uint32_t bytes) {
  std::string out(bytes, '\0');
  for (uint32_t i = 0; i < bytes; ++i) out[i] = static_cast<char>(value >> 8 * (bytes - 1 - i) & 0xFF);
  return out;
}

std::string png_chunk(std::string_view type, std::string_view data) {
  std::string named(type);
  named += data;
  const auto crc = crc32_z(0, reinterpret_cast<const Bytef*>(named.data()), named.size());
  return big_endian(static_cast<uint32_t>(data.size())) + named + big_endian(static_cast<uint32_t>(crc));
}

std::vector<PngChunk> png_chunks(std::string_view file) {
  if (!file.starts_with(kPngSignature)) throw std::logic_error("not a PNG file");
  std::vector<PngChunk> chunks;
  for (size_t at = kPngSignature.size(); at < file.size();) {
    if (file.size() - at < 12) throw std::logic_error("a PNG file that is cut off");
    const uint32_t length = read_big_endian(file.substr(at, 4));
    if (file.size() - at - 12 < length) throw std::logic_error("a PNG file that is cut off");
    chunks.push_back({file.substr(at + 4, 4), file.substr(at + 8, length)});
    at += 12 + size_t(length);
  }
  return chunks;
}

}  // namespace vsglbench
