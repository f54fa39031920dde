// Camera and light of a view in a scene.json.
#pragma once

#include <string>

#include "base/json.h"
#include "scene/scene.h"

namespace vsglbench {

// Sets scene->camera and scene->light from the view at `pointer` ("/views/A") of a document that follows the
// schema; `unit` is metres per length unit there. The scene's geometry must be complete. Error(scene)
// "FILE:LINE: ..." for a zero direction, two of direction and target, or a light that is none.
void apply_view(const JsonDocument& document, const std::string& pointer, double unit, Scene* scene);

// Near and far planes of camera and spot light from the geometry: far behind all of it; near as far out as
// no triangle before it can be in view (cameras up to an aspect of 4:1), but at least 1e-4 of the diagonal.
// A directional light is moved back until all geometry lies before it. Call again after anything moves.
void fit_depth_ranges(Scene* scene);

}  // namespace vsglbench
