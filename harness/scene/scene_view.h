// Camera, light and region of a view in a scene.json.
#pragma once

#include <string>

#include "base/json.h"
#include "scene/depth_range.h"
#include "scene/scene.h"
#include "scene/scene_problems.h"

namespace vsglbench {

// All that is wrong with a view by itself, whatever the geometry: what apply_view() refuses but for what only
// a frame shows.
void check_view(const std::string& pointer, double unit, SceneProblems* problems);

// Sets scene->camera, scene->light, how they move, and scene->region from the view at `pointer` ("/views/A")
// of a document that follows the schema; `unit` is metres per length unit there. The scene's geometry must be
// complete and measured (measure_motion). Error(scene) "FILE:LINE: ..." for a zero direction, two of
// direction and target, a light that is none, keys that lead to no camera or light in some frame, a
// region whose ends are the wrong way round, or an object that leaves a sun's rectangle which was not given.
void apply_view(const JsonDocument& document, const std::string& pointer, double unit, Scene* scene);

}  // namespace vsglbench
