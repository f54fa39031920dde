#include "scene/gltf_extensions.h"

#include <algorithm>
#include <array>

#include "base/printable.h"

namespace vsglbench {
namespace {

constexpr std::array kRead = {"KHR_mesh_quantization", "KHR_texture_transform", "EXT_mesh_gpu_instancing"};

// They say nothing of the geometry, materials and nodes that are read.
constexpr std::array kOfOtherThings = {"KHR_lights_punctual",
                                       "KHR_materials_variants",
                                       "KHR_materials_emissive_strength",
                                       "KHR_animation_pointer",
                                       "KHR_xmp",
                                       "KHR_xmp_json_ld",
                                       "KHR_audio",
                                       "KHR_audio_emitter",
                                       "KHR_audio_graph",
                                       "KHR_interactivity",
                                       "KHR_implicit_shapes",
                                       "KHR_physics_rigid_bodies",
                                       "KHR_node_hoverability",
                                       "KHR_node_selectability",
                                       "EXT_lights_ies",
                                       "EXT_lights_image_based",
                                       "EXT_instance_features",
                                       "EXT_mesh_features",
                                       "EXT_structural_metadata",
                                       "AGI_articulations",
                                       "CESIUM_primitive_outline",
                                       "MSFT_audio_emitter",
                                       "MSFT_lod"};

// Commands of glTF-Transform, https://gltf-transform.dev/cli: whatever it reads and writes is decoded.
struct Remedy {
  const char* extension;
  const char* does;
  const char* command;
};
constexpr std::array kRemedies = {
    Remedy{"KHR_draco_mesh_compression", "decompresses its meshes", "copy IN.glb OUT.glb"},
    Remedy{"EXT_meshopt_compression", "decompresses its buffers", "copy IN.glb OUT.glb"},
    Remedy{"KHR_meshopt_compression", "decompresses its buffers", "copy IN.glb OUT.glb"},
    Remedy{"KHR_texture_basisu", "turns its KTX2 images into PNG", "ktxdecompress IN.glb OUT.glb"},
    Remedy{"EXT_texture_webp", "turns its WebP images into PNG", "png IN.glb OUT.glb --formats '*'"},
    Remedy{"EXT_texture_avif", "turns its AVIF images into PNG", "png IN.glb OUT.glb --formats '*'"},
    Remedy{"KHR_materials_pbrSpecularGlossiness", "makes metallic-roughness of its materials",
           "metalrough IN.glb OUT.glb"},
};

constexpr std::array kImageExtensions = {"KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif",
                                         "MSFT_texture_dds"};

template <class List>
bool holds(const List& list, const std::string& name) {
  return std::ranges::find(list, name) != list.end();
}

std::vector<std::string> names(const GltfFile& file, const Json& root, const char* key) {
  std::vector<std::string> out;
  if (!root.is_object() || !root.contains(key)) return out;
  for (const Json& name : root[key]) {
    if (!name.is_string()) throw file.error("{}: has an entry that is no name", key);
    out.push_back(excerpt(name.get<std::string>()));
  }
  return out;
}

}  // namespace

std::string remedy(const std::string& extension) {
  const auto found =
      std::ranges::find_if(kRemedies, [&](const Remedy& r) { return r.extension == extension; });
  if (found == kRemedies.end()) return "";
  return fmt::format("; `npx @gltf-transform/cli {}` {}", found->command, found->does);
}

void check_extensions(GltfFile* file, const Json& root) {
  for (const std::string& name : names(*file, root, "extensionsRequired")) {
    if (holds(kRead, name) || holds(kOfOtherThings, name)) continue;
    throw file->error("requires the extension {}, which is not read{}", name, remedy(name));
  }
  for (const std::string& name : names(*file, root, "extensionsUsed")) {
    if (!holds(kRead, name)) file->warn(fmt::format("extension {} is ignored", name));
  }
}

std::optional<ExtensionImage> extension_image(const tinygltf::Texture& texture) {
  for (const char* name : kImageExtensions) {
    const auto found = texture.extensions.find(name);
    if (found == texture.extensions.end() || !found->second.Has("source")) continue;
    const tinygltf::Value& source = found->second.Get("source");
    if (source.IsInt()) return ExtensionImage{name, source.GetNumberAsInt()};
  }
  return std::nullopt;
}

}  // namespace vsglbench
