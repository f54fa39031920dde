// Materials and textures of a glTF file.
#pragma once

#include "scene/gltf_file.h"
#include "scene/scene.h"

namespace vsglbench {

// Appends the file's materials in its order and, last, glTF's default material; decodes, in parallel, the
// images they use. Lists what it ignores as warnings of the file.
void load_materials(GltfFile* file, Scene* scene);

// An encoded image (PNG, JPEG, …) to 8-bit RGBA; false when it is no image. `encoded` may be empty.
bool decode_image(const uint8_t* encoded, size_t size, Texture* texture);

}  // namespace vsglbench
