// Cameras and lights at a time, from their keys.
#pragma once

#include "scene/scene.h"

namespace vsglbench {

// The camera or light at `time`, seconds, but for its near and far planes, which fit_depth_ranges() sets.
// Error (scene), "it looks nowhere" or the like without a place, where the keys lead to none: no direction or
// up, an angle outside 0…180 degrees, a negative power, a position that is no number.
Camera posed(const CameraMotion& motion, const Scene& scene, double time);
Light posed(const LightMotion& motion, const Scene& scene, double time);

}  // namespace vsglbench
