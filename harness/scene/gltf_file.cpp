#include "scene/gltf_file.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <span>
#include <utility>

#include "base/file.h"
#include "base/json.h"
#include "scene/gltf_extensions.h"
#include "scene/gltf_json.h"
#include "scene/gltf_resources.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

uint32_t little_endian(const std::vector<uint8_t>& bytes, size_t at) {
  return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 | static_cast<uint32_t>(bytes[at + 3]) << 24;
}

// The chunks of a .glb, or a .gltf's whole text as the first of them.
struct Chunks {
  std::string_view json;
  std::span<const uint8_t> binary;
};

// Of a binary file whose chunks all lie within it (glTF 2.0, 4.4).
Chunks binary_chunks(const GltfFile& file, const std::vector<uint8_t>& bytes) {
  if (bytes.size() < 20) throw file.error("truncated: {} bytes are too few for a .glb", bytes.size());
  if (const uint32_t version = little_endian(bytes, 4); version != 2) {
    throw file.error("is glTF version {}, but only version 2 is read", version);
  }
  const size_t length = little_endian(bytes, 8);
  if (length > bytes.size()) {
    throw file.error("truncated: its header says {} bytes but there are {}", length, bytes.size());
  }
  // Every chunk: length, type, then that many bytes, within the length the header gives.
  Chunks chunks;
  for (size_t at = 12, number = 0; at < length; ++number) {
    const size_t room = length - at;
    const size_t chunk = room < 8 ? 0 : little_endian(bytes, at);
    if (room < 8 || chunk > room - 8) throw file.error("truncated: the chunk at byte {} leaves the file", at);
    const uint8_t* data = bytes.data() + at + 8;
    if (number == 0 && std::memcmp(&bytes[at + 4], "JSON", 4) == 0)
      chunks.json = {reinterpret_cast<const char*>(data), chunk};
    if (number == 1 && std::memcmp(&bytes[at + 4], "BIN\0", 4) == 0) chunks.binary = {data, chunk};
    at += 8 + chunk;
  }
  if (chunks.json.data() == nullptr) throw file.error("its first chunk isn't JSON");
  return chunks;
}

// What is neither a .glb nor text, in words; a parser of JSON would name its first byte only. What is a
// download gone wrong, mostly.
void refuse_what_is_neither(const GltfFile& file, const std::vector<uint8_t>& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                              std::min<size_t>(bytes.size(), 64));
  if (text.starts_with("version https://git-lfs"))
    throw file.error("is a pointer of Git LFS, not the file itself; git lfs pull fetches it");
  std::string ending = file.path.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending != ".glb" || text.find('{') != std::string_view::npos) return;
  if (bytes.empty()) throw file.error("is empty");
  throw file.error("is no .glb: it doesn't begin with 'glTF', and is no JSON either");
}

}  // namespace

void GltfFile::warn(const std::string& message) {
  if (std::find(warnings.begin(), warnings.end(), message) == warnings.end()) warnings.push_back(message);
}

void GltfFile::warn_once(const std::string& kind, const std::string& message) {
  Repeated& r = repeated_[kind];
  if (r.count++ == 0) r.first = message;
}

void GltfFile::end_warnings() {
  for (const auto& [kind, r] : repeated_)
    warn(r.count == 1 ? r.first : fmt::format("{} (so it is with {} primitives)", r.first, r.count));
  repeated_.clear();
}

GltfFile read_gltf(const fs::path& path) {
  GltfFile file;
  file.path = path;
  std::vector<uint8_t> bytes;
  try {
    bytes = read_bytes(path);
  } catch (const Error& e) {
    throw Error(ErrorKind::scene, e.what());
  }
  if (bytes.size() > 0xffffffffu) throw file.error("is larger than 4 GiB");
  const bool binary = bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
  if (!binary) refuse_what_is_neither(file, bytes);
  const Chunks chunks = binary ? binary_chunks(file, bytes)
                               : Chunks{{reinterpret_cast<const char*>(bytes.data()), bytes.size()}, {}};
  // This parse gives line-exact errors and bounds the nesting before another recurses into it.
  Json root = JsonDocument::parse(chunks.json, path.string(), ErrorKind::scene).root();
  check_version(file, root);
  check_extensions(&file, root);
  read_buffers(&file, root, chunks.binary);
  read_images(&file, root);
  parse_model(&file, std::move(root));
  return file;
}

}  // namespace vsglbench
