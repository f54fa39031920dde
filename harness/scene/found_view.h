// A view and a light for a model that brings none: candidates from the bounds of its geometry, chosen by what
// rays tell of each (shot.h).
#pragma once

#include <optional>
#include <string>

#include "scene/shot.h"

namespace vsglbench {

struct FoundView {
  Shot shot;
  ShotMeasure measure;  // by finer rays than the search's
  bool inside = false;  // whether the camera stands among the geometry, not before it
  double score = 0;     // 0 to 1, of all that is wanted of a view together
};

// What a found view must have: some of the lit surface is seen, the light lights the subject and not its
// scenery alone, and indirect light reaches much of the view.
struct WantedShot {
  double seen = 0.1, lit_seen = 0.08, subject_direct = 0.03, reached = 0.35, strength = 0.01;
};
bool is_good(const ShotMeasure& measure, const WantedShot& wanted = {});
// What an object must have by itself, or it is better off with scenery that sends light back to it.
inline constexpr WantedShot kWantedOfLoneObject{.reached = 0.6, .strength = 0.05};

// The best camera and spot there is of some thousand candidates. Cameras stand before the subject and have
// all of it in the frame, or within it where it is a place (subject.h); spots stand round it, and in it.
// `fixed_camera`, `fixed_light`: the file has one of the two, and only the other is looked for.
// `subject_triangles`: only the first so many are what the pictures are of; what follows (a floor, walls) is
// scenery. The light's intensity is such that a surface half as far as the lit points gets 40 W/m². Nothing
// where no candidate sees anything that is lit.
struct ViewSearch {
  std::optional<Camera> fixed_camera;
  std::optional<Light> fixed_light;
  uint32_t subject_triangles = ~0u;
};
std::optional<FoundView> find_view(const TriangleTree& tree, const ViewSearch& search = {});

}  // namespace vsglbench
