#include "image/labelled.h"

#include <algorithm>
#include <stdexcept>

#include "base/error.h"
#include "base/file.h"
#include "image/exr.h"
#include "image/png_chunks.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

bool is_plain(unsigned char c) { return c >= 0x20 && c < 0x7f; }

// Of iTXt, between name and text: not compressed, of no language, its name in no other.
constexpr std::string_view kPlainUtf8("\0\0\0\0\0", 5);

std::string text_chunk(const std::string& name, const std::string& text) {
  if (name.empty() || name.size() > 79 || !std::ranges::all_of(name, is_plain))
    throw std::logic_error("'" + name + "' can't name a text of a PNG");
  if (std::ranges::all_of(text, is_plain)) return png_chunk("tEXt", name + '\0' + text);
  return png_chunk("iTXt", name + std::string(kPlainUtf8) + text);
}

}  // namespace

Labels radiance_labels() {
  return {{"units", "W/(sr m^2), linear Rec. 709"},
          {"A",
           "1: the camera sees a surface, the pixel counts in every error; 0: it does not. Colours are not "
           "multiplied by it"}};
}

void write_exr(const fs::path& path, const Image& image, const std::vector<uint8_t>& coverage,
               const Labels& labels) {
  std::vector<float> alpha(image.pixels.size(), 1);
  for (size_t i = 0; i < std::min(alpha.size(), coverage.size()); ++i) alpha[i] = coverage[i] ? 1.0f : 0.0f;
  write_exr(path, ExrLayers{image.width, image.height, {{"", image}}, {{"A", alpha}}, labels});
}

void write_png(const fs::path& path, const Bitmap& bitmap, const Labels& labels) {
  std::string encoded;
  try {
    encoded = with_labels(encode_png(bitmap), labels);
  } catch (const Error& e) {
    throw fail(ErrorKind::output, "{}: {}", path.string(), e.what());
  }
  write_text(path, encoded);
}

std::string with_labels(const std::string& png, const Labels& labels) {
  // Behind the signature and the first chunk, IHDR.
  const std::vector<PngChunk> chunks = png_chunks(png);
  const size_t at = static_cast<size_t>(chunks.at(0).data.data() - png.data()) + chunks[0].data.size() + 4;
  std::string texts;
  for (const auto& [name, text] : labels) texts += text_chunk(name, text);
  return png.substr(0, at) + texts + png.substr(at);
}

Labels png_labels(std::string_view png) {
  Labels out;
  for (const PngChunk& chunk : png_chunks(png)) {
    if (chunk.type != "tEXt" && chunk.type != "iTXt") continue;
    const size_t end = chunk.data.find('\0');
    const size_t skip = chunk.type == "tEXt" ? 1 : kPlainUtf8.size();
    out[std::string(chunk.data.substr(0, end))] = std::string(chunk.data.substr(end + skip));
  }
  return out;
}

}  // namespace vsglbench
