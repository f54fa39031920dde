#include "image/png.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "base/error.h"
#include "base/file.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr uint64_t kMaxBytes = 1ull << 31;

// libpng's simplified interface, freed on every path.
struct PngImage : png_image {
  PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(this); }
};

}  // namespace

uint8_t encode_srgb(float value) {
  const float v = value > 0 ? std::min(value, 1.0f) : 0.0f;
  const float encoded = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
  return static_cast<uint8_t>(std::lround(255 * encoded));
}

Bitmap tone_map(const Image& image, float exposure) {
  Bitmap out(image.width, image.height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const glm::vec3 c = image.pixels[i];
    const bool finite = std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
    uint8_t* rgb = &out.bytes[3 * i];
    for (int k = 0; k < 3; ++k) rgb[k] = finite ? encode_srgb(exposure * c[k]) : (k == 1 ? 0 : 255);
  }
  return out;
}

Bitmap enlarge(const Bitmap& bitmap, uint32_t across, uint32_t down) {
  if (across == 0 || down == 0) throw std::logic_error("a picture enlarged 0 times");
  if (across == 1 && down == 1) return bitmap;
  Bitmap out(bitmap.width * across, bitmap.height * down, bitmap.channels);
  for (uint32_t y = 0; y < out.height; ++y) {
    for (uint32_t x = 0; x < out.width; ++x)
      std::copy_n(bitmap.at(x / across, y / down), bitmap.channels, out.at(x, y));
  }
  return out;
}

std::string encode_png(const Bitmap& bitmap) {
  const uint64_t size = uint64_t(bitmap.width) * bitmap.height * bitmap.channels;
  if (size == 0 || bitmap.bytes.size() != size || (bitmap.channels != 3 && bitmap.channels != 4)) {
    throw fail(ErrorKind::output, "cannot be written as PNG: {}x{} pixels of {} channels in {} bytes",
               bitmap.width, bitmap.height, bitmap.channels, bitmap.bytes.size());
  }
  PngImage png;
  png.width = bitmap.width;
  png.height = bitmap.height;
  png.format = bitmap.channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string encoded(bytes, '\0');
  if (!png_image_write_to_memory(&png, encoded.data(), &bytes, 0, bitmap.bytes.data(), 0, nullptr))
    throw fail(ErrorKind::output, "cannot be written as PNG: {}", png.message);
  encoded.resize(bytes);
  return encoded;
}

void write_png(const fs::path& path, const Bitmap& bitmap) {
  std::string encoded;
  try {
    encoded = encode_png(bitmap);
  } catch (const Error& e) {
    throw fail(ErrorKind::output, "{}: {}", path.string(), e.what());
  }
  write_text(path, encoded);
}

void write_png(const fs::path& path, const Image& image, float exposure) {
  write_png(path, tone_map(image, exposure));
}

Bitmap read_png(const fs::path& path) {
  const std::vector<uint8_t> bytes = read_bytes(path);
  PngImage png;
  const auto check = [&](bool good) {
    if (!good) throw fail(ErrorKind::output, "{}: not a readable PNG file: {}", path.string(), png.message);
  };
  check(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()));
  png.format = png.format & PNG_FORMAT_FLAG_ALPHA ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  const uint32_t channels = PNG_IMAGE_PIXEL_CHANNELS(png.format);
  if (uint64_t(png.width) * png.height * channels > kMaxBytes) {
    throw fail(ErrorKind::output, "{}: {}x{} pixels are too many", path.string(), png.width, png.height);
  }
  Bitmap out(png.width, png.height, channels);
  check(png_image_finish_read(&png, nullptr, out.bytes.data(), 0, nullptr));
  return out;
}

}  // namespace vsglbench
