// A scene as files that other renderers read.
#pragma once

#include <filesystem>

#include "base/json.h"
#include "scene/scene.h"

namespace vsglbench {

// Writes FOLDER/scene.gltf with scene.bin and texture-N.png: the present pose's triangles, materials as
// metallic-roughness (a Phong exponent e as the roughness of GGX alpha √(2/(e + 2))), camera, and the light
// as KHR_lights_punctual, a spot's cone inside its square frustum. Beside it scene.json, which gives each
// material back what glTF has no words for, so that FOLDER is the same scene here; facts.json, the numbers
// that render_cycles.py goes by; that script and README.md. `width`, `height`: of pictures to compare. Throws
// Error(output).
void export_scene(const Scene& scene, const std::filesystem::path& folder, uint32_t width, uint32_t height);

}  // namespace vsglbench
