// The hard cases: each a made-up half, looked at from made-up surfaces, or a small scene.
// scenes/hard/README.md says why each is hard and what must come out.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "frame/frame.h"
#include "stability/receivers.h"

namespace vsglbench {

struct HalfCase {
  oracle::Half half;
  uint32_t lights = 16;  // N
  std::optional<double>
      footprint_size;       // parameter K, of methods that have one; the others leave the case out
  bool no_surface = false;  // lights of power must not come
  bool no_flux = false;     // nor here
  bool no_pdf = false;      // nor here from methods that use importance
  std::function<oracle::Half(const oracle::Half&, const std::vector<LightSpot>&)> receivers =
      scattered_receivers;
};

struct SceneCase {
  Scene scene;
  uint32_t lights = 16;
};
// The size of every scene case's frame: the camera's image, and an RSM of as many texels a side.
inline constexpr uint32_t kSceneWidth = 40, kSceneHeight = 24, kSceneRsm = 24;

struct HardCase {
  std::string name;
  std::string what;                  // one line
  std::function<HalfCase()> half;    // one of these two
  std::function<SceneCase()> scene;  // may throw
  bool models = false;               // whether each diffuse model has a cell of its own
  std::string refusal;               // part of the Error's message that must come; empty: none may
};

const std::vector<HardCase>& hard_cases();

// The two parts of it, in order.
std::vector<HardCase> half_cases();
std::vector<HardCase> scene_cases();

}  // namespace vsglbench
