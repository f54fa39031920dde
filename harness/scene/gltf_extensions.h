// What a glTF file's extensions mean to this reader.
#pragma once

#include <optional>
#include <string>

#include "base/json.h"
#include "scene/gltf_file.h"

namespace vsglbench {

// Error(scene) for an extension that the file requires and that this reader lacks: with the command that
// removes it, where there is one. One that concerns only what is not read anyway, such as variants, refuses
// no file. Warns of those in use that change what is drawn and are ignored.
void check_extensions(GltfFile* file, const Json& root);

// Of a texture whose image stands in an extension alone: the extension's name and the image's index, or
// nothing.
struct ExtensionImage {
  std::string extension;
  int image = -1;
};
std::optional<ExtensionImage> extension_image(const tinygltf::Texture& texture);

// "; `gltf-transform …` …", or nothing.
std::string remedy(const std::string& extension);

}  // namespace vsglbench
