#include "scene/gltf_material.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <thread>
#include <utility>

#include "scene/gltf_extensions.h"

namespace vsglbench {
namespace {

constexpr float kDefaultCutoff = 0.5f;  // glTF 2.0, 3.9.4

// A texture that a material refers to.
struct TextureUse {
  int texture;  // glTF's index, or -1
  bool srgb;
  bool needed;       // else a missing image is a warning
  std::string what;  // "material wood: normalTexture"
};

// The images that materials use, each once as sRGB and once as linear data at most.
class TextureList {
 public:
  TextureList(GltfFile* file, Scene* scene) : file_(*file), scene_(*scene) {}

  // Index of the scene texture, made on first use; -1 where there is none to read.
  int use(const TextureUse& use) {
    if (use.texture == -1) return -1;
    const auto& texture = element(file_, file_.model.textures, use.texture, use.what);
    const int source = source_of(texture, use.what);
    if (source < 0) return -1;
    const auto& image = element(file_, file_.model.images, source, use.what + ": image");
    warn_of_ignored(texture, use.what);
    const auto [it, is_new] =
        index_.try_emplace({source, use.srgb}, static_cast<int>(scene_.textures.size()));
    if (is_new) {
      Texture entry;
      entry.name = !image.name.empty()  ? image.name
                   : !image.uri.empty() ? image.uri
                                        : fmt::format("image {}", source);
      entry.srgb = use.srgb;
      scene_.textures.push_back(std::move(entry));
      sources_.push_back({encoded_bytes(image, source), use.what, image.uri, extension_of(texture), false});
    }
    sources_[static_cast<size_t>(it->second)].needed |= use.needed;
    return it->second;
  }

  // Decodes all images in use, on all cores. The first one that is needed and no image is the error;
  // materials do without the others, which are left out of the scene.
  void decode() {
    std::vector<uint8_t> good(sources_.size(), 0);
    std::atomic<size_t> next{0};
    const auto work = [&] {
      for (size_t i; (i = next++) < sources_.size();) {
        good[i] = decode_image(sources_[i].bytes.data, sources_[i].bytes.size, &scene_.textures[i]);
      }
    };
    std::vector<std::thread> threads;
    const size_t count = std::min<size_t>(std::max(1u, std::thread::hardware_concurrency()), sources_.size());
    for (size_t i = 0; i < count; ++i) threads.emplace_back(work);
    for (std::thread& t : threads) t.join();
    std::vector<int> place(sources_.size(), -1);
    std::vector<Texture> kept;
    for (size_t i = 0; i < sources_.size(); ++i) {
      if (!good[i] && !may_lack(i)) throw file_.error("{}", problem_of(i));
      if (!good[i]) continue;
      place[i] = static_cast<int>(kept.size());
      kept.push_back(std::move(scene_.textures[i]));
    }
    scene_.textures = std::move(kept);
    for (Material& m : scene_.materials) {
      for (int* t : {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture})
        if (*t >= 0) *t = place[static_cast<size_t>(*t)];
    }
  }

 private:
  struct Source {
    ByteRange bytes;
    std::string what, uri;
    std::string extension;  // the image stands in, if in no other place
    bool needed;
  };

  static std::string extension_of(const tinygltf::Texture& texture) {
    if (texture.source >= 0) return "";
    const auto found = extension_image(texture);
    return found ? found->extension : "";
  }

  // The index of a texture's image. One that stands in an extension alone may still be a PNG or JPEG.
  int source_of(const tinygltf::Texture& texture, const std::string& what) {
    if (texture.source >= 0) return texture.source;
    if (const auto found = extension_image(texture)) return found->image;
    file_.warn(fmt::format("{}: its texture names no image; it is left out", what));
    return -1;
  }

  // Warns of an image that can't be read and that nothing needs, or that stands in an extension.
  bool may_lack(size_t i) {
    const Source& source = sources_[i];
    if (source.needed && source.extension.empty()) return false;
    const std::string why = source.needed ? remedy(source.extension) : "; nothing that is drawn needs it";
    file_.warn(fmt::format("{}; the texture is left out{}", problem_of(i), why));
    return true;
  }

  std::string problem_of(size_t i) const {
    const Source& source = sources_[i];
    if (source.bytes.size == 0 && !source.uri.empty())
      return fmt::format("{}: its file '{}' is missing or empty", source.what, source.uri);
    if (!source.extension.empty())
      return fmt::format("{}: its image stands in {} alone, which is not read", source.what,
                         source.extension);
    return fmt::format("{}: texture {} is not an image that can be read (PNG or JPEG)", source.what,
                       scene_.textures[i].name);
  }

  ByteRange encoded_bytes(const tinygltf::Image& image, int index) {
    if (image.bufferView >= 0) return view_bytes(file_, image.bufferView, fmt::format("image {}", index));
    return {image.image.data(), image.image.size()};
  }

  void warn_of_ignored(const tinygltf::Texture& texture, const std::string& what) {
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
  std::vector<Source> sources_;  // one a scene texture
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

// How the textures of a material lie on a mesh. All have the coordinates of the first. A vertex has one pair,
// to which the transform is applied as it is read, so that a surface costs no more for it: of its own, each
// texture would have to have a pair a vertex, or a matrix a material, in the vertex format, the material
// records, four shaders, the ray tracer, masks and tangents, for what few files have. A texture that lies
// elsewhere is named.
class MaterialUvs {
 public:
  void add(GltfFile* file, const UvMapping& mapping, const std::string& material, const char* slot) {
    if (first_.empty()) {
      mapping_ = mapping;
      first_ = slot;
    } else if (!(mapping == mapping_)) {
      file->warn(fmt::format(
          "material {}: {} lies elsewhere than {} (another TEXCOORD or KHR_texture_transform); it is "
          "read where that one lies",
          material, slot, first_));
    }
  }
  const UvMapping& mapping() const { return mapping_; }

 private:
  UvMapping mapping_;
  std::string first_;
};

Material read_material(GltfFile* file, size_t index, bool used, TextureList* textures, UvMapping* uvs) {
  const tinygltf::Material& from = file->model.materials[index];
  const auto& pbr = from.pbrMetallicRoughness;
  Material to;
  to.name = from.name.empty() ? fmt::format("material {}", index) : from.name;
  for (int k = 0; k < 4; ++k) to.base_color[k] = static_cast<float>(pbr.baseColorFactor.at(k));
  to.metallic = static_cast<float>(pbr.metallicFactor);
  to.roughness = static_cast<float>(pbr.roughnessFactor);
  to.normal_scale = static_cast<float>(from.normalTexture.scale);
  to.double_sided = from.doubleSided;
  read_alpha(file, from, &to);
  MaterialUvs places;
  const auto use = [&](const auto& info, bool srgb, const char* slot) {
    const std::string what = fmt::format("material {}: {}", to.name, slot);
    const int texture = textures->use({info.index, srgb, used, what});
    if (texture >= 0)
      places.add(file, uv_mapping(*file, info.texCoord, info.extensions, what), to.name, slot);
    return texture;
  };
  to.base_color_texture = use(pbr.baseColorTexture, true, "baseColorTexture");
  to.metallic_roughness_texture = use(pbr.metallicRoughnessTexture, false, "metallicRoughnessTexture");
  to.normal_texture = use(from.normalTexture, false, "normalTexture");
  *uvs = places.mapping();
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

std::vector<UvMapping> load_materials(GltfFile* file, const std::vector<bool>& used, Scene* scene) {
  TextureList textures(file, scene);
  std::vector<UvMapping> uvs(file->model.materials.size() + 1);
  for (size_t i = 0; i < file->model.materials.size(); ++i) {
    scene->materials.push_back(read_material(file, i, used[i], &textures, &uvs[i]));
  }
  // glTF 2.0, 3.9.1: what a primitive without a material gets.
  Material standard;
  standard.name = "(default)";
  standard.base_color = glm::vec4(1);
  standard.metallic = 1;
  scene->materials.push_back(standard);
  textures.decode();
  return uvs;
}

}  // namespace vsglbench
