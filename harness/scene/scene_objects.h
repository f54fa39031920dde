// Objects that a scene.json adds to its geometry, and their keys.
#pragma once

#include "base/json.h"
#include "scene/scene.h"
#include "scene/scene_problems.h"

namespace vsglbench {

// All that is wrong with the `objects`, each by itself.
void check_objects(SceneProblems* problems);

// Appends the `objects` of a document that follows the schema, with materials of their own, and measures how
// all moves (measure_motion); `unit` is metres per length unit of the views and objects. Error(scene)
// "FILE:LINE: ..." for a name that stands twice, a tube thicker than its ring, bad keys, or an object that is
// nowhere in some frame.
void add_objects(const JsonDocument& document, double unit, Scene* scene);

}  // namespace vsglbench
