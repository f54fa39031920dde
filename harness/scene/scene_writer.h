// The parts of the scene.json that a model amounts to, with numbers as a person would write them.
#pragma once

#include <string>
#include <vector>

#include "base/json.h"
#include "scene/found_view.h"
#include "scene/gltf_views.h"

namespace vsglbench {

// As the file has them.
Json json_of(const GltfCamera& camera);
Json json_of(const GltfLight& light);

class SceneWriter {
 public:
  // Keeps a reference to the model's geometry: all of a scene's triangles, without scenery.
  explicit SceneWriter(const Scene& geometry);

  // A found view: `description`, `camera` and `light`, to four digits of the scene's size.
  Json view_of(const FoundView& found) const;
  // A floor and two walls, as `objects`: behind the geometry, to its left, and a little below it, so that no
  // surfaces coincide.
  Json scenery() const;
  // Bounds, number of triangles, unit and materials, for the reader, and so that a changed file is noticed.
  Json about(const std::vector<std::string>& notes) const;

 private:
  glm::dvec3 world(const glm::vec3& p) const { return glm::dvec3(p) + geometry_.origin; }
  Json place(const glm::dvec3& p) const;

  const Scene& geometry_;
  int decimals_;
};

}  // namespace vsglbench
