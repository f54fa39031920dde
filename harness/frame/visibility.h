// How a shading point sees a light: an axis of the experiment [light-transport §6].
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "method/method.h"
#include "scene/scene.h"

namespace vsglbench {

enum class Visibility { none, exact, ism };
Visibility parse_visibility(const std::string& name);  // throws Error(config)
const char* visibility_name(Visibility v);

// Where a shadow ray ends: `stop_short` metres before `position`. For a VSGL that is its mean, one standard
// deviation before it, since the mean of a curved cluster lies inside the solid.
struct LightPoint {
  glm::vec3 position{0};
  float stop_short = 0;
};

// Fills visibility bits of `lights` for every pixel of the G-buffer: word light * words + pixel / 32, bit
// pixel % 32, words = ceil(pixels / 32). Given by the caller, who has a ray tracer; frame/ has none.
using ExactVisibility = std::function<std::vector<uint32_t>(const std::vector<LightPoint>& lights)>;

struct IsmParameters {
  uint32_t size = 64;      // texels a side, a power of two
  uint32_t points = 8192;  // splatted into each map
};

// Imperfect shadow maps of all lights (Ritschel et al. 2008), as passes visibility.ism.*.
class ImperfectShadowMaps {
 public:
  ImperfectShadowMaps(KernelLibrary& kernels, ScratchPool& scratch, const Scene& scene,
                      IsmParameters parameters);
  struct Maps {
    const Buffer *depth, *frames;
    uint32_t size;
  };
  Maps build(Recorder& recorder, const Buffer& lights, LightKind kind, uint32_t count);

 private:
  void fill_holes(Recorder& recorder, uint32_t count);
  Buffer& level(uint32_t size, uint32_t count);
  KernelLibrary& kernels_;
  ScratchPool& scratch_;
  IsmParameters parameters_;
  Buffer points_;
  uint32_t pool_ = 0;
};

}  // namespace vsglbench
