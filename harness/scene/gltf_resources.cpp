#include "scene/gltf_resources.h"

#include <array>

#include "base/file.h"
#include "base/printable.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// %20 as a space [RFC 3986, 2.1].
std::string percent_decoded(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool escape = text[i] == '%' && i + 2 < text.size();
    const int high = escape ? hex_digit(text[i + 1]) : -1, low = escape ? hex_digit(text[i + 2]) : -1;
    if (high < 0 || low < 0) {
      out += text[i];
    } else {
      out += static_cast<char>(16 * high + low);
      i += 2;
    }
  }
  return out;
}

// Of base64 [RFC 4648, 4]; ends at the first character that is none.
std::vector<uint8_t> base64_decoded(std::string_view text) {
  static const std::array<int8_t, 256> digits = [] {
    std::array<int8_t, 256> table{};
    table.fill(-1);
    const std::string_view all = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < all.size(); ++i) table[static_cast<uint8_t>(all[i])] = static_cast<int8_t>(i);
    return table;
  }();
  std::vector<uint8_t> out;
  out.reserve(text.size() / 4 * 3);
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int8_t digit = digits[static_cast<uint8_t>(c)];
    if (digit < 0) break;
    bits = bits << 6 | static_cast<uint32_t>(digit);
    if ((count += 6) < 8) continue;
    out.push_back(static_cast<uint8_t>(bits >> (count -= 8)));
  }
  return out;
}

bool is_data_uri(const std::string& uri) { return uri.starts_with("data:"); }

// data:MIME;base64,… or data:MIME,… [RFC 2397].
std::vector<uint8_t> data_of(const GltfFile& file, const std::string& uri, const std::string& what) {
  const size_t comma = uri.find(',');
  if (comma == std::string::npos) throw file.error("{}: its data URI has no comma", what);
  if (std::string_view(uri).substr(0, comma).ends_with(";base64"))
    return base64_decoded(std::string_view(uri).substr(comma + 1));
  const std::string text = percent_decoded(uri.substr(comma + 1));
  return {text.begin(), text.end()};
}

// Where a file stands that is named relative to the glTF file; nothing where none does.
fs::path file_beside(const GltfFile& file, const std::string& uri) {
  if (uri.find("://") != std::string::npos || uri.starts_with("/")) return {};
  const fs::path folder = fs::absolute(file.path).parent_path();
  for (const std::string& name : {percent_decoded(uri), uri}) {
    std::error_code ec;
    if (name.find('\0') == std::string::npos && fs::is_regular_file(folder / name, ec)) return folder / name;
  }
  return {};
}

std::vector<uint8_t> file_bytes(const GltfFile& file, const fs::path& path) {
  try {
    return read_bytes(path);
  } catch (const Error& e) {
    throw file.error("{}", e.what());
  }
}

// The entries of one of the root's arrays.
const Json& entries(const GltfFile& file, const Json& root, const char* key) {
  static const Json none = Json::array();
  const auto it = root.find(key);
  if (it == root.end()) return none;
  if (!it->is_array()) throw file.error("its '{}' is no array", key);
  return *it;
}

std::string text_of(const GltfFile& file, const Json& entry, const char* key, const std::string& what) {
  const auto it = entry.find(key);
  if (it == entry.end()) return "";
  if (!it->is_string()) throw file.error("{}: its {} is no string", what, key);
  return it->get<std::string>();
}

tinygltf::Buffer read_buffer(const GltfFile& file, const Json& entry, bool has_chunk,
                             std::span<const uint8_t> chunk, const std::string& what) {
  if (!entry.is_object()) throw file.error("{}: is no object", what);
  const auto length = entry.find("byteLength");
  if (length == entry.end() || !length->is_number_unsigned())
    throw file.error("{}: its byteLength is no number of bytes", what);
  const auto bytes = length->get<uint64_t>();
  tinygltf::Buffer buffer;
  const std::string uri = text_of(file, entry, "uri", what);
  std::string source = "its data URI";
  if (is_data_uri(uri)) {
    buffer.data = data_of(file, uri, what);
  } else if (!uri.empty()) {
    source = fmt::format("its file '{}'", excerpt(uri));
    const fs::path path = file_beside(file, uri);
    if (path.empty()) throw file.error("{}: {} is missing; it must lie beside this one", what, source);
    buffer.data = file_bytes(file, path);
  } else if (has_chunk) {
    source = "the file's binary chunk";
    buffer.data.assign(chunk.begin(), chunk.end());
  } else if (entry.contains("extensions")) {
    return buffer;  // whoever compresses it may leave it away; what refers to it fails
  } else {
    throw file.error("{}: has no uri", what);
  }
  if (buffer.data.size() < bytes) {
    throw file.error("{}: {} has {} bytes, but its byteLength is {}", what, source, buffer.data.size(),
                     bytes);
  }
  buffer.data.resize(bytes);
  return buffer;
}

}  // namespace

void read_buffers(GltfFile* file, const Json& root, std::span<const uint8_t> chunk) {
  const Json& list = entries(*file, root, "buffers");
  for (size_t i = 0; i < list.size(); ++i) {
    const bool has_chunk = i == 0 && chunk.data() != nullptr;
    file->model.buffers.push_back(read_buffer(*file, list[i], has_chunk, chunk, fmt::format("buffer {}", i)));
  }
}

void read_images(GltfFile* file, const Json& root) {
  const Json& list = entries(*file, root, "images");
  for (size_t i = 0; i < list.size(); ++i) {
    const std::string what = fmt::format("image {}", i);
    if (!list[i].is_object()) throw file->error("{}: is no object", what);
    tinygltf::Image image;
    image.name = excerpt(text_of(*file, list[i], "name", what));
    image.mimeType = excerpt(text_of(*file, list[i], "mimeType", what));
    const std::string uri = text_of(*file, list[i], "uri", what);
    if (const auto view = list[i].find("bufferView"); view != list[i].end()) {
      if (!view->is_number_integer()) throw file->error("{}: its bufferView is no index", what);
      image.bufferView = view->get<int>();
    } else if (is_data_uri(uri)) {
      image.image = data_of(*file, uri, what);
    } else if (!uri.empty()) {
      image.uri = excerpt(percent_decoded(uri));
      if (const fs::path path = file_beside(*file, uri); !path.empty()) image.image = file_bytes(*file, path);
    }
    file->model.images.push_back(std::move(image));
  }
}

}  // namespace vsglbench
