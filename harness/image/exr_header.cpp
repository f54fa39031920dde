#include "image/exr_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

namespace vsglbench {
namespace {

// Bytes of a value [OpenEXR 3.1, "OpenEXR File Layout", Predefined Attribute Types]. A type that is not here
// takes what it states.
struct TypeSize {
  std::string_view type;
  uint32_t bytes;
};
constexpr TypeSize kTypeSizes[] = {
    {"box2f", 16},
    {"box2i", 16},
    {"chromaticities", 32},
    {"compression", 1},
    {"deepImageState", 1},
    {"double", 8},
    {"envmap", 1},
    {"float", 4},
    {"int", 4},
    {"keycode", 28},
    {"lineOrder", 1},
    {"m33d", 72},
    {"m33f", 36},
    {"m44d", 128},
    {"m44f", 64},
    {"rational", 8},
    {"tiledesc", 9},
    {"timecode", 8},
    {"v2d", 16},
    {"v2f", 8},
    {"v2i", 8},
    {"v3d", 24},
    {"v3f", 12},
    {"v3i", 12},
};
constexpr size_t kLongestName = 255;
constexpr uint64_t kMaxChannels = 256;
// Lines that are decoded at once, by the value of `compression`: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A,
// DWAA and DWAB.
constexpr uint64_t kLinesAtOnce[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
// ZIP's deflate gains at most a factor of 1032; a header that promises more is damaged.
constexpr uint64_t kMaxCompression = 1100;
// What a header may promise besides: a tile, or the lines that are decoded at once, may be larger than the
// image.
constexpr uint64_t kImageRoom = 1 << 16, kPieceRoom = 16 << 20;
constexpr size_t kChannelBytes = 16;  // its pixel type, a flag, 3 bytes unused, and two samplings
constexpr uint32_t kMultiPart = 0x1000;

// A part of the file that is read from its start on.
class Cursor {
 public:
  explicit Cursor(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  size_t left() const { return bytes_.size(); }

  std::span<const uint8_t> take(size_t count) {
    if (count > left()) throw std::runtime_error("its header ends too early");
    const auto taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
  }

  // Four bytes, the lowest first.
  uint32_t word() {
    const auto b = take(4);
    return b[0] | b[1] << 8 | b[2] << 16 | uint32_t{b[3]} << 24;
  }

  // The text up to a byte 0.
  std::string_view name() {
    const auto at = bytes_.first(std::min(left(), kLongestName + 1));
    const auto length = static_cast<size_t>(std::ranges::find(at, 0) - at.begin());
    if (length == at.size()) throw std::runtime_error("a name in its header does not end");
    take(length + 1);
    return {reinterpret_cast<const char*>(at.data()), length};
  }

 private:
  std::span<const uint8_t> bytes_;
};

// What OpenEXR makes room by.
struct Layout {
  int64_t width = 1, height = 1;
  uint64_t tile_pixels = 0, lines_at_once = 1, channels = 0;
};

// Whether a list of channels ends where its attribute does.
bool channels_fill(Cursor value) {
  while (!value.name().empty()) value.take(kChannelBytes);
  return value.left() == 0;
}

bool fills(std::string_view type, std::span<const uint8_t> value) {
  if (type == "chlist") return channels_fill(Cursor(value));
  if (type == "floatvector") return value.size() % sizeof(float) == 0;
  const auto* known = std::ranges::find(kTypeSizes, type, &TypeSize::type);
  return known == std::end(kTypeSizes) || value.size() == known->bytes;
}

// Of an attribute whose value fills its type. The last one counts, but channels add up.
void read_layout(std::string_view name, std::string_view type, Cursor value, Layout* layout) {
  if (name == "dataWindow" && type == "box2i") {
    const auto side = [&] { return int64_t{static_cast<int32_t>(value.word())}; };
    const int64_t left = side(), top = side();
    layout->width = side() - left + 1;
    layout->height = side() - top + 1;
  } else if (name == "tiles" && type == "tiledesc") {
    const uint64_t across = value.word();
    layout->tile_pixels = across * value.word();
  } else if (name == "compression" && type == "compression") {
    const size_t kind = value.take(1)[0];
    layout->lines_at_once = kind < std::size(kLinesAtOnce) ? kLinesAtOnce[kind] : 1;
  } else if (name == "channels" && type == "chlist") {
    for (; !value.name().empty(); ++layout->channels) value.take(kChannelBytes);
  }
}

// Refuses what would take absurdly more memory than the file holds: the image, or a piece that is decoded at
// once.
void check_room(const Layout& layout, uint64_t file_bytes) {
  const auto& [width, height, tile_pixels, lines_at_once, channels] = layout;
  if (width < 1 || height < 1 || width > kMaxExrSide || height > kMaxExrSide)
    throw std::runtime_error(fmt::format("its size {}x{} is out of range", width, height));
  if (channels > kMaxChannels) throw std::runtime_error(fmt::format("it has {} channels", channels));
  const uint64_t pixel_bytes = std::max<uint64_t>(channels, 1) * sizeof(float);
  const auto fits = [&](uint64_t pixels, uint64_t room) {
    return pixels <= (file_bytes * kMaxCompression + room) / pixel_bytes;
  };
  if (!fits(uint64_t(width) * height, kImageRoom))
    throw std::runtime_error(fmt::format("{} bytes cannot hold {}x{} pixels", file_bytes, width, height));
  if (const uint64_t pixels = std::max(tile_pixels, width * lines_at_once); !fits(pixels, kPieceRoom))
    throw std::runtime_error(fmt::format("{} bytes cannot hold tiles of {} pixels", file_bytes, pixels));
}

// False at the end of the header.
bool check_attribute(Cursor& file, Layout* layout) {
  const std::string_view name = file.name();
  if (name.empty()) return false;
  const std::string_view type = file.name();
  const uint32_t size = file.word();
  if (size > file.left()) {
    throw std::runtime_error(
        fmt::format("its attribute '{}' states {} bytes where {} are left", name, size, file.left()));
  }
  // OpenEXR 3.1 reads another number of bytes than it writes of this type.
  if (type == "idmanifest")
    throw std::runtime_error(fmt::format("its attribute '{}' is an idmanifest", name));
  const auto value = file.take(size);
  if (!fills(type, value)) {
    throw std::runtime_error(
        fmt::format("its attribute '{}' states {} bytes, not those of its type '{}'", name, size, type));
  }
  read_layout(name, type, Cursor(value), layout);
  return true;
}

// False where there is no attribute, which ends the headers of a file of several parts.
bool check_header(Cursor& file, uint64_t file_bytes) {
  Layout layout;
  if (!check_attribute(file, &layout)) return false;
  while (check_attribute(file, &layout)) {
  }
  check_room(layout, file_bytes);
  return true;
}

}  // namespace

void check_exr_headers(std::span<const uint8_t> bytes) {
  Cursor file(bytes);
  file.word();  // the magic number
  const bool several = file.word() & kMultiPart;
  while (check_header(file, bytes.size()) && several) {
  }
}

}  // namespace vsglbench
