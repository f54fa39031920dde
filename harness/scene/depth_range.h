// Near and far planes for the rasteriser.
#pragma once

#include "scene/scene.h"

namespace vsglbench {

// Near and far planes of camera and light from the geometry, over all frames of the objects that move: far
// behind all of it; near as far out as no triangle before it can be in view (cameras up to an aspect of 4:1),
// but at least 1e-4 of the diagonal. A directional light is moved back until all geometry lies before it.
// Call again after anything but an object moves: while a camera or light stands still, its planes do.
void fit_depth_ranges(Scene* scene);
void fit_camera_depth(Scene* scene);
void fit_light_depth(Scene* scene);

}  // namespace vsglbench
