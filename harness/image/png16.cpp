#include "image/png16.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/file.h"
#include "image/metrics.h"
#include "image/png_chunks.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr uint32_t kPixelBytes = 6;
constexpr int kCompression = 6;

// Two bytes a channel, the higher first.
std::string encode_pixels(const Image& image, float peak) {
  std::string out;
  out.reserve(image.pixels.size() * kPixelBytes);
  for (const glm::vec3& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) {
      const uint16_t code = encode_srgb16(double(pixel[c]) / peak);
      out += static_cast<char>(code >> 8);
      out += static_cast<char>(code & 0xFF);
    }
  }
  return out;
}

// Each row led by its filter's number, and each byte less that of the pixel to the left (PNG third edition,
// 9.2: Sub): neighbours are alike.
std::string filter_rows(const std::string& pixels, uint32_t width) {
  const size_t row = size_t(width) * kPixelBytes;
  std::string out;
  out.reserve(pixels.size() + pixels.size() / row);
  for (size_t start = 0; start < pixels.size(); start += row) {
    out += '\1';
    for (size_t i = 0; i < row; ++i) {
      const int left = i < kPixelBytes ? 0 : static_cast<uint8_t>(pixels[start + i - kPixelBytes]);
      out += static_cast<char>(static_cast<uint8_t>(pixels[start + i]) - left);
    }
  }
  return out;
}

std::string compressed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), kCompression) != Z_OK) {
    throw fail(ErrorKind::output, "{} bytes cannot be compressed", bytes.size());
  }
  out.resize(size);
  return out;
}

std::string quote(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// Quoted where a shell would take it for more than a word.
std::string word(const std::string& text) {
  const auto plain = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' ||
           c == '-' || c == '.';
  };
  return !text.empty() && std::ranges::all_of(text, plain) ? text : quote(text);
}

}  // namespace

uint16_t encode_srgb16(double value) {
  const double v = value > 0 ? std::min(value, 1.0) : 0;
  const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  return static_cast<uint16_t>(std::lround(65535 * encoded));
}

Png16Loss write_png16(const fs::path& path, const Image& image, float peak) {
  if (image.pixels.empty() || !(peak > 0) || !std::isfinite(peak)) {
    throw fail(ErrorKind::output, "{}: cannot be written as PNG: {}x{} pixels with a peak of {} W/m²/sr",
               path.string(), image.width, image.height, peak);
  }
  check_comparable(image, image, {});
  Png16Loss loss;
  for (const glm::vec3& p : image.pixels) {
    loss.above += std::max({p.x, p.y, p.z}) > peak;
    loss.below += std::min({p.x, p.y, p.z}) < 0;
  }
  // 16 bits a channel, RGB; deflate, the five filters, no interlace.
  const std::string header =
      big_endian(image.width) + big_endian(image.height) + std::string("\x10\x02\0\0\0", 5);
  const std::string comment =
      std::string("Comment\0", 8) + fmt::format("sRGB; linear 1 (code 65535) is {} W/m2/sr", peak);
  std::string file(kPngSignature);
  file += png_chunk("IHDR", header) + png_chunk("sRGB", std::string(1, '\0')) + png_chunk("tEXt", comment);
  file += png_chunk("IDAT", compressed(filter_rows(encode_pixels(image, peak), image.width)));
  file += png_chunk("IEND", "");
  write_text(path, file);
  return loss;
}

std::string frame_file_name(uint32_t frame) { return fmt::format("{:04}.png", frame); }

std::string cvvdp_command(const fs::path& test, const fs::path& reference, double frames_per_second,
                          const std::string& display) {
  return fmt::format("cvvdp --test {} --ref {} --fps {} --display {}", quote((test / "%04d.png").string()),
                     quote((reference / "%04d.png").string()), frames_per_second, word(display));
}

}  // namespace vsglbench
