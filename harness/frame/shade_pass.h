// Shading: the light sets' radiance at every pixel, each light through its visibility.
#pragma once

#include <vector>

#include "frame/frame_parameters.h"
#include "frame/half_lights.h"

namespace vsglbench {

// Push constants of shade.comp, which says what they mean.
struct ShadePush {
  gpu::Emitter emitter;
  uint32_t first = 0, count = 0, words = 0, accumulate = 0, map_size = 0;
  float map_tolerance = 0;
  uint32_t random = 0;
  float radius2_scale = 1, weight = 1, alpha = 0;
};

// Defines of shade.comp for lights of this kind, but for VISIBILITY and BIAS_REDUCTION.
ShaderDefines shade_defines(LightKind kind, const Shading& shading);

class ShadePass {
 public:
  // `lights`: on the RSM. `exact` is called for Visibility::exact only.
  ShadePass(Stage& stage, const Halves& halves, const HalfLights& lights, const FrameParameters& parameters,
            ExactVisibility exact);

  // The host's shadow rays to the lights that were just made, unless they are the last ones.
  void trace();
  // After the scene has moved: the next lights are traced though they be the last ones.
  void forget() { traced_.clear(); }
  // Passes shade.texels, visibility.* and shade; iterations after the first add to what is there. After the
  // last, shade.join where pixels share the lights out.
  void record(Recorder& recorder, uint32_t seed, uint32_t iteration);

  // vec4 a pixel: radiance, and what shade.comp says of it.
  const Buffer& indirect() const;
  // What shade.comp writes: the same, unless pixels share the lights out and are still to be joined.
  const Buffer& shaded() const;
  bool reduces_bias() const;
  // What pixels were shaded by where the shading is filtered; else none.
  std::vector<gpu::FilteredLight> read_filtered_lights() const;

 private:
  // Whether what is nearer to a VSGL's mean than its standard deviation is no occluder.
  bool clears_sigma() const { return chosen(parameters_.shading, "light_clearance") == "sigma"; }
  bool filters() const;
  const Buffer& filtered_lights() const;
  void filter_lights(Recorder& recorder) const;
  // Bias reduction and unfiltered lobes need a texel for each light.
  bool needs_light_texels() const;
  std::vector<LightPoint> light_points() const;
  const Buffer& light_texels(Recorder& recorder) const;
  // Lights of one dispatch, and what it binds for their visibility.
  struct Sight {
    uint32_t most_lights;
    std::vector<const Buffer*> bits;  // of each range of lights
  };
  Sight see(Recorder& recorder, ShadePush* push, Bindings* bound) const;
  Sight upload_bits(uint32_t words) const;
  void join(Recorder& recorder) const;

  Stage& stage_;
  const Halves& halves_;
  const HalfLights& lights_;
  const FrameParameters& parameters_;
  ExactVisibility exact_;
  std::vector<LightPoint> traced_;  // the lights whose bits are in bits_
  std::vector<uint32_t> bits_;
};

}  // namespace vsglbench
