#include "image/exr.h"

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <half.h>

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "base/file.h"
#include "image/exr_header.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

// Files pass through memory: OpenEXR's own output stream loses the error of a disk that fills up as it
// closes.
class MemoryOutput : public Imf::OStream {
 public:
  MemoryOutput() : OStream("memory") {}
  void write(const char c[], int n) override {
    if (at_ + n > bytes_.size()) bytes_.resize(at_ + n);
    std::memcpy(bytes_.data() + at_, c, n);
    at_ += n;
  }
  uint64_t tellp() override { return at_; }
  void seekp(uint64_t pos) override { at_ = pos; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  uint64_t at_ = 0;
};

class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(const std::vector<uint8_t>& bytes) : IStream("memory"), bytes_(bytes) {}
  bool read(char c[], int n) override {
    if (n < 0 || at_ > bytes_.size() || bytes_.size() - at_ < size_t(n)) {
      throw std::runtime_error("ends too early");
    }
    std::memcpy(c, bytes_.data() + at_, n);
    at_ += n;
    return at_ < bytes_.size();
  }
  uint64_t tellg() override { return at_; }
  void seekg(uint64_t pos) override { at_ = pos; }

 private:
  const std::vector<uint8_t>& bytes_;
  uint64_t at_ = 0;
};

std::string channel_name(const std::string& layer, char component) {
  return layer.empty() ? std::string(1, component) : layer + "." + component;
}

// A float channel of `width` columns whose first value is at `data`, for a data window that starts at
// `origin`.
Imf::Slice float_slice(const float* data, const Imath::V2i& origin, size_t stride, size_t width) {
  // What would be the value at (0, 0), which may lie outside of the array.
  const auto address = reinterpret_cast<intptr_t>(data) -
                       static_cast<intptr_t>((origin.x + static_cast<intptr_t>(origin.y) * width) * stride);
  char* base = reinterpret_cast<char*>(address);  // NOLINT(performance-no-int-to-ptr)
  return Imf::Slice(Imf::FLOAT, base, stride, stride * width);
}

void insert_color(Imf::FrameBuffer& frame, const std::string& layer, const Image& image,
                  const Imath::V2i& origin = {0, 0}) {
  for (int c = 0; c < 3; ++c) {
    frame.insert(channel_name(layer, "RGB"[c]),
                 float_slice(&image.pixels[0][c], origin, sizeof(glm::vec3), image.width));
  }
}

void check_sizes(const ExrLayers& layers) {
  if (layers.width == 0 || layers.height == 0) throw std::runtime_error("the image is empty");
  if (layers.colors.empty() && layers.scalars.empty()) throw std::runtime_error("there is no layer");
  const size_t count = size_t(layers.width) * layers.height;
  for (const auto& [name, image] : layers.colors) {
    if (image.width != layers.width || image.height != layers.height || image.pixels.size() != count) {
      throw std::runtime_error(fmt::format("layer '{}' is {}x{}, not {}x{}", name, image.width, image.height,
                                           layers.width, layers.height));
    }
  }
  for (const auto& [name, values] : layers.scalars) {
    if (values.size() != count) {
      throw std::runtime_error(fmt::format("layer '{}' has {} values, not {}", name, values.size(), count));
    }
  }
}

std::string encode(const ExrLayers& layers) {
  check_sizes(layers);
  Imf::Header header(static_cast<int>(layers.width), static_cast<int>(layers.height));
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  for (const auto& [name, image] : layers.colors) insert_color(frame, name, image);
  for (const auto& [name, values] : layers.scalars) {
    frame.insert(name, float_slice(values.data(), {0, 0}, sizeof(float), layers.width));
  }
  for (auto it = frame.begin(); it != frame.end(); ++it)
    header.channels().insert(it.name(), Imf::Channel(Imf::FLOAT));
  for (const auto& [name, text] : layers.attributes) header.insert(name, Imf::StringAttribute(text));
  MemoryOutput memory;
  {
    Imf::OutputFile file(memory, header);
    file.setFrameBuffer(frame);
    file.writePixels(static_cast<int>(layers.height));
  }
  return memory.bytes();
}

constexpr float kHalfMost = 65504;

half to_half(float value) { return half(std::clamp(value, -kHalfMost, kHalfMost)); }

// A subsampled channel has fewer values than the image has pixels.
void check_sampling(const Imf::ChannelList& channels) {
  for (auto it = channels.begin(); it != channels.end(); ++it) {
    if (it.channel().xSampling != 1 || it.channel().ySampling != 1)
      throw std::runtime_error(fmt::format("channel '{}' is subsampled", it.name()));
  }
}

// Names of the complete R, G, B triples among the channels.
std::vector<std::string> color_layers(const Imf::ChannelList& channels) {
  std::vector<std::string> layers;
  for (auto it = channels.begin(); it != channels.end(); ++it) {
    const std::string name = it.name();
    if (name != "R" && !name.ends_with(".R")) continue;
    const std::string layer = name == "R" ? "" : name.substr(0, name.size() - 2);
    if (channels.findChannel(channel_name(layer, 'G')) && channels.findChannel(channel_name(layer, 'B'))) {
      layers.push_back(layer);
    }
  }
  return layers;
}

ExrLayers decode(const std::vector<uint8_t>& bytes) {
  // Refuse absurd sizes before the library makes room for them.
  check_exr_headers(bytes);
  Imf::Header::setMaxImageSize(kMaxExrSide, kMaxExrSide);
  Imf::Header::setMaxTileSize(kMaxExrSide, kMaxExrSide);
  MemoryInput memory(bytes);
  Imf::InputFile file(memory);
  if (!file.isComplete()) throw std::runtime_error("it is truncated");
  check_sampling(file.header().channels());
  const Imath::Box2i window = file.header().dataWindow();
  const Imath::V2i size = window.size() + Imath::V2i(1), origin = window.min;

  ExrLayers layers;
  layers.width = size.x;
  layers.height = size.y;
  Imf::FrameBuffer frame;
  for (const auto& name : color_layers(file.header().channels())) {
    Image& image = layers.colors[name] = Image(layers.width, layers.height);
    insert_color(frame, name, image, origin);
  }
  const Imf::ChannelList& channels = file.header().channels();
  for (auto it = channels.begin(); it != channels.end(); ++it) {
    if (frame.findSlice(it.name())) continue;
    auto& values = layers.scalars[it.name()];
    values.resize(size_t(layers.width) * layers.height);
    frame.insert(it.name(), float_slice(values.data(), origin, sizeof(float), layers.width));
  }
  file.setFrameBuffer(frame);
  file.readPixels(origin.y, origin.y + size.y - 1);

  for (auto it = file.header().begin(); it != file.header().end(); ++it) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute());
    if (text) layers.attributes[it.name()] = text->value();
  }
  return layers;
}

// "Y, Z, left.RGB", without what a terminal would obey.
std::string channels_of(const ExrLayers& layers) {
  constexpr size_t kMostShown = 8;
  std::vector<std::string> names;
  for (const auto& [name, values] : layers.scalars) names.push_back(name);
  for (const auto& [name, image] : layers.colors) names.push_back(name + ".RGB");
  std::string out;
  for (size_t i = 0; i < std::min(names.size(), kMostShown); ++i) out += (i ? ", " : "") + names[i];
  if (names.size() > kMostShown) out += ", …";
  for (char& c : out) c = static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
  return out.empty() ? "none" : out;
}

// The library's messages may run over several lines.
std::string one_line(std::string message) {
  for (char& c : message) c = c == '\n' ? ' ' : c;
  return message;
}

}  // namespace

void write_exr(const fs::path& path, const Image& image) {
  write_exr(path, ExrLayers{image.width, image.height, {{"", image}}, {}, {}});
}

void write_exr(const fs::path& path, const Image& image, const std::vector<uint8_t>& coverage) {
  std::vector<float> alpha(image.pixels.size(), 1);
  if (!coverage.empty()) {
    alpha.assign(coverage.size(), 0);
    for (size_t i = 0; i < coverage.size(); ++i) alpha[i] = coverage[i] ? 1.0f : 0.0f;
  }
  write_exr(path, ExrLayers{image.width, image.height, {{"", image}}, {{"A", alpha}}, {}});
}

void write_exr(const fs::path& path, const ExrLayers& layers) {
  std::string bytes;
  try {
    bytes = encode(layers);
  } catch (const std::exception& e) {
    throw fail(ErrorKind::output, "{}: cannot be written as EXR: {}", path.string(), one_line(e.what()));
  }
  write_text(path, bytes);
}

std::string encode_half_exr(const Image& image, const std::vector<float>& alpha) {
  const size_t n = image.pixels.size();
  if (n == 0) throw std::runtime_error("the image is empty");
  if (!alpha.empty() && alpha.size() != n) throw std::logic_error("alpha is of another size");
  // One channel after the other.
  std::vector<half> values;
  values.reserve(4 * n);
  for (int c = 0; c < 3; ++c) {
    for (const glm::vec3& p : image.pixels) values.push_back(to_half(p[c]));
  }
  for (const float a : alpha) values.push_back(to_half(a));
  Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  for (size_t c = 0; c < values.size() / n; ++c) {
    const std::string name(1, "RGBA"[c]);
    header.channels().insert(name, Imf::Channel(Imf::HALF));
    frame.insert(name, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(&values[c * n]), sizeof(half),
                                  sizeof(half) * image.width));
  }
  MemoryOutput memory;
  {
    Imf::OutputFile file(memory, header);
    file.setFrameBuffer(frame);
    file.writePixels(static_cast<int>(image.height));
  }
  return memory.bytes();
}

ExrLayers read_exr_layers(const fs::path& path) {
  const std::vector<uint8_t> bytes = read_bytes(path);
  try {
    return decode(bytes);
  } catch (const std::exception& e) {
    throw fail(ErrorKind::output, "{}: not a readable EXR file: {}", path.string(), one_line(e.what()));
  }
}

Image read_exr(const fs::path& path) {
  ExrLayers layers = read_exr_layers(path);
  const auto it = layers.colors.find("");
  if (it == layers.colors.end()) {
    throw fail(ErrorKind::output, "{}: lacks the channels R, G and B; it has {}", path.string(),
               channels_of(layers));
  }
  return std::move(it->second);
}

}  // namespace vsglbench
