#include "scene/gltf_material.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <thread>
#include <utility>

namespace vsglbench {
namespace {

constexpr float kDefaultCutoff = 0.5f;  // glTF 2.0, 3.9.4

// The images that materials use, each once as sRGB and once as linear data at most.
class TextureList {
 public:
  TextureList(GltfFile* file, Scene* scene) : file_(*file), scene_(*scene) {}

  // Index of the scene texture for glTF texture `index` (or -1), made on first use.
  int use(int index, int tex_coord, const tinygltf::ExtensionMap& extensions, bool srgb,
          const std::string& what) {
    if (index == -1) return -1;
    const auto& texture = element(file_, file_.model.textures, index, what);
    const auto& image = element(file_, file_.model.images, texture.source, what + ": image");
    warn_of_ignored(texture, tex_coord, extensions, what);
    const auto [it, is_new] =
        index_.try_emplace({texture.source, srgb}, static_cast<int>(scene_.textures.size()));
    if (is_new) {
      Texture entry;
      entry.name = !image.name.empty()  ? image.name
                   : !image.uri.empty() ? image.uri
                                        : fmt::format("image {}", texture.source);
      entry.srgb = srgb;
      scene_.textures.push_back(std::move(entry));
      sources_.push_back(encoded_bytes(image, texture.source, what));
    }
    return it->second;
  }

  // Decodes all images in use, on all cores. The first one that is no image is the error.
  void decode() {
    std::vector<uint8_t> good(sources_.size(), 0);
    std::atomic<size_t> next{0};
    const auto work = [&] {
      for (size_t i; (i = next++) < sources_.size();) {
        good[i] = decode_image(sources_[i].data, sources_[i].size, &scene_.textures[i]);
      }
    };
    std::vector<std::thread> threads;
    const size_t count = std::min<size_t>(std::max(1u, std::thread::hardware_concurrency()), sources_.size());
    for (size_t i = 0; i < count; ++i) threads.emplace_back(work);
    for (std::thread& t : threads) t.join();
    const auto bad = std::find(good.begin(), good.end(), 0);
    if (bad != good.end()) {
      throw file_.error("texture {}: is not an image that can be read (PNG or JPEG)",
                        scene_.textures[static_cast<size_t>(bad - good.begin())].name);
    }
  }

 private:
  ByteRange encoded_bytes(const tinygltf::Image& image, int index, const std::string& what) {
    if (image.bufferView >= 0) return view_bytes(file_, image.bufferView, fmt::format("image {}", index));
    if (image.image.empty()) {
      throw file_.error("{}: the file '{}' of image {} is missing or empty", what, image.uri, index);
    }
    return {image.image.data(), image.image.size()};
  }

  void warn_of_ignored(const tinygltf::Texture& texture, int tex_coord,
                       const tinygltf::ExtensionMap& extensions, const std::string& what) {
    if (tex_coord != 0) file_.warn(fmt::format("{}: TEXCOORD_{} is read as TEXCOORD_0", what, tex_coord));
    if (extensions.count("KHR_texture_transform") > 0) {
      file_.warn(fmt::format("{}: its KHR_texture_transform is ignored", what));
    }
    if (texture.sampler < 0) return;
    const auto& sampler = element(file_, file_.model.samplers, texture.sampler, what + ": sampler");
    if (sampler.wrapS != TINYGLTF_TEXTURE_WRAP_REPEAT || sampler.wrapT != TINYGLTF_TEXTURE_WRAP_REPEAT) {
      file_.warn("textures that clamp or mirror are read as repeating");
    }
    if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) {
      file_.warn("textures with nearest filtering are read with bilinear filtering");
    }
  }

  GltfFile& file_;
  Scene& scene_;
  std::map<std::pair<int, bool>, int> index_;
  std::vector<ByteRange> sources_;  // one a scene texture
};

void read_alpha(GltfFile* file, const tinygltf::Material& from, Material* to) {
  if (from.alphaMode == "MASK") {
    to->alpha_cutoff = static_cast<float>(std::max(from.alphaCutoff, 0.0));
  } else if (from.alphaMode == "BLEND") {
    to->alpha_cutoff = kDefaultCutoff;
    file->warn(fmt::format("material {}: alpha blending is read as a mask with cutoff 0.5", to->name));
  } else if (!from.alphaMode.empty() && from.alphaMode != "OPAQUE") {
    throw file->error("material {}: unknown alphaMode '{}'", to->name, from.alphaMode);
  }
}

Material read_material(GltfFile* file, const tinygltf::Material& from, size_t index, TextureList* textures) {
  const auto& pbr = from.pbrMetallicRoughness;
  Material to;
  to.name = from.name.empty() ? fmt::format("material {}", index) : from.name;
  for (int k = 0; k < 4; ++k) to.base_color[k] = static_cast<float>(pbr.baseColorFactor.at(k));
  to.metallic = static_cast<float>(pbr.metallicFactor);
  to.roughness = static_cast<float>(pbr.roughnessFactor);
  to.normal_scale = static_cast<float>(from.normalTexture.scale);
  to.double_sided = from.doubleSided;
  read_alpha(file, from, &to);
  const auto use = [&](const auto& info, bool srgb, const char* slot) {
    return textures->use(info.index, info.texCoord, info.extensions, srgb,
                         fmt::format("material {}: {}", to.name, slot));
  };
  to.base_color_texture = use(pbr.baseColorTexture, true, "baseColorTexture");
  to.metallic_roughness_texture = use(pbr.metallicRoughnessTexture, false, "metallicRoughnessTexture");
  to.normal_texture = use(from.normalTexture, false, "normalTexture");
  const auto emits = [](double e) { return e > 0; };
  if (std::any_of(from.emissiveFactor.begin(), from.emissiveFactor.end(), emits)) {
    file->warn(fmt::format("material {}: its emission is ignored", to.name));
  }
  return to;
}

uint32_t big_endian(const uint8_t* at) { return uint32_t{at[0]} << 24 | at[1] << 16 | at[2] << 8 | at[3]; }

// Whether a PNG's first chunk promises no more pixels than `size` bytes can hold.
bool fits_png(const uint8_t* png, size_t size) {
  constexpr uint32_t kMaxSide = 1 << 24;
  constexpr uint64_t kChannels[] = {1, 1, 3, 1, 2, 1, 4}, kMaxCompression = 1100, kAlwaysRoom = 1 << 16;
  if (size < 26) return false;
  if (!std::equal(png + 12, png + 16, "IHDR")) return true;
  const uint64_t width = big_endian(png + 16), height = big_endian(png + 20), depth = png[24];
  if (width > kMaxSide || height > kMaxSide || png[25] >= std::size(kChannels)) return false;
  return width * height * kChannels[png[25]] * depth / 8 <= size * kMaxCompression + kAlwaysRoom;
}

// False for a PNG that promises more than it holds: the library makes room for up to 1 GiB before it finds
// that out.
bool keeps_promises(const uint8_t* encoded, size_t size) {
  constexpr uint8_t kPng[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  if (size < sizeof kPng || !std::equal(kPng, std::end(kPng), encoded)) return true;
  // Each chunk: length, type, data, and a sum.
  for (size_t at = sizeof kPng; at + 8 <= size;) {
    const size_t length = big_endian(encoded + at);
    if (length > size - at - 8) return false;
    if (std::equal(encoded + at + 4, encoded + at + 8, "IEND")) break;
    at += length + 12;
  }
  return fits_png(encoded, size);
}

}  // namespace

bool decode_image(const uint8_t* encoded, size_t size, Texture* texture) {
  if (size == 0 || size > 0x7fffffff || !keeps_promises(encoded, size)) return false;
  tinygltf::Image image;
  std::string unused;
  try {
    if (!tinygltf::LoadImageData(&image, 0, &unused, &unused, 0, 0, encoded, static_cast<int>(size),
                                 nullptr)) {
      return false;
    }
  } catch (const std::exception&) {  // larger than memory
    return false;
  }
  if (image.width < 1 || image.height < 1 || image.component != 4) return false;
  const size_t count = size_t(4) * image.width * image.height, step = image.bits == 16 ? 2 : 1;
  if (image.image.size() != count * step) return false;
  texture->width = static_cast<uint32_t>(image.width);
  texture->height = static_cast<uint32_t>(image.height);
  if (step == 1) {
    texture->rgba = std::move(image.image);
  } else {  // the high byte of each little-endian 16-bit value
    texture->rgba.resize(count);
    for (size_t i = 0; i < count; ++i) texture->rgba[i] = image.image[2 * i + 1];
  }
  return true;
}

void load_materials(GltfFile* file, Scene* scene) {
  TextureList textures(file, scene);
  for (size_t i = 0; i < file->model.materials.size(); ++i) {
    scene->materials.push_back(read_material(file, file->model.materials[i], i, &textures));
  }
  // glTF 2.0, 3.9.1: what a primitive without a material gets.
  Material standard;
  standard.name = "(default)";
  standard.base_color = glm::vec4(1);
  standard.metallic = 1;
  scene->materials.push_back(standard);
  textures.decode();
}

}  // namespace vsglbench
