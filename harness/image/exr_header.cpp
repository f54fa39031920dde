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

// False at the end of the header.
bool check_attribute(Cursor& file) {
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
  if (!fills(type, file.take(size))) {
    throw std::runtime_error(
        fmt::format("its attribute '{}' states {} bytes, not those of its type '{}'", name, size, type));
  }
  return true;
}

// False where there is no attribute, which ends the headers of a file of several parts.
bool check_header(Cursor& file) {
  if (!check_attribute(file)) return false;
  while (check_attribute(file)) {
  }
  return true;
}

}  // namespace

void check_exr_headers(std::span<const uint8_t> bytes) {
  Cursor file(bytes);
  file.word();  // the magic number
  const bool several = file.word() & kMultiPart;
  while (check_header(file) && several) {
  }
}

}  // namespace vsglbench
