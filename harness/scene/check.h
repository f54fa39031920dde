// What must hold of every scene before anyone renders it.
#pragma once

#include <string>

#include "scene/scene.h"

namespace vsglbench {

// Array sizes agree, indices are in range, batches cover the triangles in order, all numbers are finite and
// in their ranges, light and camera have unit orthogonal axes, there is at least one triangle; the same in
// every frame (check_motion). Error(scene).
void check_scene(const Scene& scene);

// Hash of everything that determines radiance: geometry, materials, texels, light, camera. Of a
// scene that moves: in its present pose; frames of equal pose have equal hashes. Not of names, near and far
// planes, the origin, the region, or warnings.
std::string scene_hash(const Scene& scene);

}  // namespace vsglbench
