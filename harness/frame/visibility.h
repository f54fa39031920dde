// How a shading point sees a light: an axis of the experiment [light-transport §6].
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "frame/ism_surface.h"
#include "frame/scene_gpu.h"
#include "method/method.h"
#include "scene/scene.h"

namespace vsglbench {

//  none   no test between light and pixel
//  exact  shadow rays on the host
//  ism    imperfect shadow maps (Ritschel et al. 2008)
//  aism   the same with points chosen for each map and the view (Ritschel et al. 2011)
//  tism   the same with tessellated triangles for points (Barák et al. 2013)
enum class Visibility { none, exact, ism, aism, tism };
const std::vector<std::string>& visibility_names();    // in the order of the enumeration
Visibility parse_visibility(const std::string& name);  // throws Error(config)
std::string visibility_name(Visibility v);
inline bool has_shadow_maps(Visibility v) { return v >= Visibility::ism; }

// How near to a VSGL's mean nothing counts as an occluder, as a share of the scene's diagonal, and no more
// than the light's σ; and how much farther than a shadow map's depth a receiver may be. The papers test a
// light at its mean, by shadow maps, whose bias lets through that the mean of a bent cluster lies a little
// below its surface: a ray without any tolerance finds every such light hidden.
inline constexpr float kVisibilityTolerance = 1e-3f;

// Where a shadow ray ends: `stop_short` metres before `position`. For a VSGL that is its mean μ, where both
// papers test it ([VSGL14], [MFIS16]: one test a light), but for the tolerance above; with `light_clearance`
// sigma one standard deviation before it.
struct LightPoint {
  glm::vec3 position{0};
  float stop_short = 0;
};

// Fills visibility bits of `lights` for every pixel of the G-buffer: word light * words + pixel / 32, bit
// pixel % 32, words = ceil(pixels / 32). Given by the caller, who has a ray tracer; frame/ has none.
using ExactVisibility = std::function<std::vector<uint32_t>(const std::vector<LightPoint>& lights)>;

struct IsmParameters {
  uint32_t size = 64;      // texels a side, a power of two
  uint32_t points = 8192;  // ism, aism: splatted into each map; tism: pieces no smaller than 2π/points sr
};

// Memory of shadow maps, which techniques and sizes share.
struct ShadowMapMemory {
  GrowingBuffer frames;
  std::map<uint32_t, GrowingBuffer> levels;  // by texels a side
};

// Imperfect shadow maps of all lights, as passes visibility.TECHNIQUE.{splat,pull,push}. The techniques
// differ in which points of the scene are splatted into a map:
//   ism   a random share of points spread over the scene's area (Ritschel et al. 2008 §4)
//   aism  drawn for the map by solid angle and by what they may hide from the camera (Ritschel et al. 2011)
//   tism  pieces of all triangles, about as large as texels (Barák et al. 2013)
// The shaders say where they depart from the papers. Holes of alpha-masked texels are not in the maps.
class ImperfectShadowMaps {
 public:
  // `technique`: one that has shadow maps.
  ImperfectShadowMaps(KernelLibrary& kernels, ShadowMapMemory& memory, const Scene& scene,
                      Visibility technique, IsmParameters parameters);
  struct Maps {
    const Buffer *depth, *frames;
    uint32_t size;
    float tolerance;  // metres, by which a receiver may be farther away than the map's depth
  };
  // `seen`: what the camera sees, for techniques that adapt to it. `clears_sigma`: what is nearer to a VSGL's
  // mean than its standard deviation is no occluder. `lobes`: that the lights have (shaders/types.h).
  Maps build(Recorder& recorder, const Buffer& lights, LightKind kind, uint32_t count,
             const DeferredTargets& seen, bool clears_sigma = false,
             unsigned lobes = DIFFUSE_LOBE | SPECULAR_LOBE);
  // The bytes of all buffers for `count` lights, beside the scene as the rasteriser has it: what points are
  // made from (for aism and tism with a copy of positions and triangles), maps with their pyramids, and
  // frames.
  size_t memory_bytes(uint32_t count) const;

 private:
  void splat(Recorder& recorder, const Buffer& frames, const Buffer& maps, uint32_t count,
             const DeferredTargets& seen);
  void fill_holes(Recorder& recorder, uint32_t count);
  size_t level_bytes(uint32_t size, uint32_t count) const;
  Buffer& level(uint32_t size, uint32_t count);
  PassId pass(const char* step) const;
  KernelLibrary& kernels_;
  ShadowMapMemory& memory_;
  Visibility technique_;
  IsmParameters parameters_;
  float tolerance_;             // metres
  Buffer points_;               // ism
  SurfaceClustersGpu surface_;  // aism, tism
};

}  // namespace vsglbench
