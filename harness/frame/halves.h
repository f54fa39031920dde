// Both halves of a frame: the G-buffer, which the eye sees, and the RSM, which the primary light sees.
#pragma once

#include <array>

#include "frame/stage.h"

namespace vsglbench {

class Halves {
 public:
  Halves(Stage& stage, uint32_t width, uint32_t height, uint32_t rsm, const EffectSet& effects);
  // Takes over what set_frame() moved of camera and light.
  void follow(const Moved& moved);
  // Rasterises both, with the same bits either way. Returns the triangles drawn. In motion a half whose view
  // stands still in all frames takes what stands still from a layer (StillLayers).
  enum class Motion { none, frames };
  uint64_t draw(Recorder& recorder, Motion motion = Motion::none) const;

  const DeferredTargets& targets(Half half) const { return *of(half).targets; }
  const gpu::Emitter& emitter(Half half) const { return of(half).emitter; }
  const Buffer& emitter_buffer(Half half) const { return of(half).buffer; }
  uint64_t texels(Half half) const { return uint64_t(emitter(half).width) * emitter(half).height; }
  Field field(Half half, const Buffer* pdf) const;

 private:
  struct Seen {
    View view;
    DeferredTargets* targets = nullptr;
    gpu::Emitter emitter{};
    Buffer buffer;  // the emitter, for shaders
  };
  const Seen& of(Half half) const { return seen_[static_cast<size_t>(half)]; }
  bool moves(Half half) const;
  void see_camera();
  void see_light();
  void see(Half half, const View& view, const glm::vec3& power);
  Stage& stage_;
  EffectSet effects_;
  std::array<Seen, 2> seen_;
};

}  // namespace vsglbench
