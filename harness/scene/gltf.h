// glTF 2.0 files (.gltf, .glb) to flat arrays. Source: Khronos, "glTF 2.0 Specification" (2021).
#pragma once

#include <filesystem>

#include "scene/scene.h"

namespace vsglbench {

// Fills geometry, materials, textures and warnings of `scene`; positions are multiplied by `unit_scale`
// (metres per file unit) and rebased to the centre of their bounds, which becomes scene->origin.
// Where scene->animation has frames, the file's animations of nodes are read, too, and what they move becomes
// moving objects; the origin and the bounds' centre are then those of what stands still.
//
// Read: the default scene (or, where the file names none, its first; without scenes, all root nodes) with
// its node hierarchy, transformed in double; triangles, strips and fans; indices of any type or none; sparse
// accessors; skins at rest; base colour, metallic-roughness and normal textures (PNG, JPEG; file, data URI,
// buffer view); alpha masks; the extensions KHR_mesh_quantization, KHR_texture_transform and
// EXT_mesh_gpu_instancing. Missing normals become flat ones, as the specification asks; missing tangents are
// made from the uvs. What is ignored or repaired is listed in scene->warnings. Anything malformed, and any
// required extension that would change what is read, throws Error(scene): one line with file and thing.
void load_gltf(const std::filesystem::path& path, double unit_scale, Scene* scene);

}  // namespace vsglbench
