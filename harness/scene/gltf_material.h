// Materials and textures of a glTF file.
#pragma once

#include <vector>

#include "scene/gltf_file.h"
#include "scene/gltf_uv.h"
#include "scene/scene.h"

namespace vsglbench {

// Appends the file's materials in its order and, last, glTF's default material; decodes, in parallel, the
// images they refer to. `used`: which of them a primitive has; a missing or damaged image of the others is a
// warning. Lists what it ignores as warnings of the file. Returns, of each material, how its textures lie on
// a mesh: a vertex has one pair of coordinates, so that of textures that differ the first counts.
std::vector<UvMapping> load_materials(GltfFile* file, const std::vector<bool>& used, Scene* scene);

// An encoded image (PNG, JPEG, …) to 8-bit RGBA; false when it is no image. `encoded` may be empty.
bool decode_image(const uint8_t* encoded, size_t size, Texture* texture);

}  // namespace vsglbench
