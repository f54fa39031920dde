#include "scene/gltf_file.h"

#include <algorithm>
#include <cstring>

#include "base/file.h"
#include "base/json.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr const char* kSupportedExtensions[] = {"KHR_mesh_quantization"};

uint32_t little_endian(const std::vector<uint8_t>& bytes, size_t at) {
  return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 | static_cast<uint32_t>(bytes[at + 3]) << 24;
}

// The JSON chunk of a binary file whose chunks all lie within it (glTF 2.0, 4.4).
std::string_view json_chunk(const GltfFile& file, const std::vector<uint8_t>& bytes) {
  if (bytes.size() < 20) throw file.error("truncated: {} bytes are too few for a .glb", bytes.size());
  if (const uint32_t version = little_endian(bytes, 4); version != 2) {
    throw file.error("is glTF version {}, but only version 2 is read", version);
  }
  const size_t length = little_endian(bytes, 8);
  if (length > bytes.size()) {
    throw file.error("truncated: its header says {} bytes but there are {}", length, bytes.size());
  }
  // Every chunk: length, type, then that many bytes, within the length the header gives.
  for (size_t at = 12; at < length;) {
    const size_t room = length - at;
    const size_t chunk = room < 8 ? 0 : little_endian(bytes, at);
    if (room < 8 || chunk > room - 8) throw file.error("truncated: the chunk at byte {} leaves the file", at);
    at += 8 + chunk;
  }
  const size_t json_length = little_endian(bytes, 12);
  if (length < 20 || std::memcmp(&bytes[16], "JSON", 4) != 0) throw file.error("its first chunk isn't JSON");
  return {reinterpret_cast<const char*>(bytes.data()) + 20, json_length};
}

void check_extensions(GltfFile& file, const Json& root) {
  const auto names = [&root](const char* key) {
    std::vector<std::string> out;
    if (!root.is_object() || !root.contains(key)) return out;
    for (const Json& name : root[key])
      out.push_back(name.is_string() ? name.get<std::string>() : name.dump());
    return out;
  };
  const auto supported = [](const std::string& name) {
    return std::find(std::begin(kSupportedExtensions), std::end(kSupportedExtensions), name) !=
           std::end(kSupportedExtensions);
  };
  for (const std::string& name : names("extensionsRequired")) {
    if (!supported(name)) throw file.error("requires the extension {}, which is not supported", name);
  }
  for (const std::string& name : names("extensionsUsed")) {
    if (!supported(name)) file.warn(fmt::format("extension {} is ignored", name));
  }
}

// Keeps the encoded bytes of files and data URIs; decoding comes later, for the images in use only.
bool keep_encoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void*) {
  if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
  return true;
}

// tinygltf also looks in the working directory; only what lies beside the file belongs to it.
bool exists_beside(const std::string& candidate, void* base) {
  std::error_code ec;
  return candidate.starts_with(*static_cast<const std::string*>(base)) && fs::is_regular_file(candidate, ec);
}

std::string one_line(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  for (size_t at; (at = text.find('\n')) != std::string::npos;) text.replace(at, 1, "; ");
  return text.size() > 300 ? text.substr(0, 300) + "…" : text;
}

void parse_model(GltfFile& file, const std::vector<uint8_t>& bytes, bool binary) {
  std::string base = fs::absolute(file.path).parent_path().string();
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_encoded, nullptr);
  tinygltf::FsCallbacks callbacks{};
  callbacks.FileExists = exists_beside;
  callbacks.ExpandFilePath = tinygltf::ExpandFilePath;
  callbacks.ReadWholeFile = tinygltf::ReadWholeFile;
  callbacks.WriteWholeFile = tinygltf::WriteWholeFile;
  callbacks.user_data = &base;
  loader.SetFsCallbacks(callbacks);
  std::string problem, ignored;
  const unsigned size = static_cast<unsigned>(bytes.size());
  const bool read =
      binary ? loader.LoadBinaryFromMemory(&file.model, &problem, &ignored, bytes.data(), size, base)
             : loader.LoadASCIIFromString(&file.model, &problem, &ignored,
                                          reinterpret_cast<const char*>(bytes.data()), size, base);
  if (!read || !problem.empty()) {
    throw file.error("{}", problem.empty() ? "not a readable glTF file" : one_line(problem));
  }
}

}  // namespace

void GltfFile::warn(const std::string& message) {
  if (std::find(warnings.begin(), warnings.end(), message) == warnings.end()) warnings.push_back(message);
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
  const std::string_view json =
      binary ? json_chunk(file, bytes)
             : std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());

  // This parse gives line-exact errors and bounds the nesting before tinygltf recurses into it.
  check_extensions(file, JsonDocument::parse(json, path.string(), ErrorKind::scene).root());
  try {
    parse_model(file, bytes, binary);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    throw file.error("not a readable glTF file: {}", one_line(e.what()));
  }
  return file;
}

}  // namespace vsglbench
