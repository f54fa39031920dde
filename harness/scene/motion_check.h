// What must hold of a scene's animation.
#pragma once

#include "scene/scene.h"

namespace vsglbench {

// Tracks are sound (problem_of), nodes stand after their parents and have finite transforms in every frame;
// objects fill the ends of the scene's arrays in order, share no vertex with other triangles, and are
// measured; camera and light are some in every frame. Error(scene).
void check_motion(const Scene& scene);

}  // namespace vsglbench
