// One frame of the experiment [light-transport §1]: gbuffer, rsm, importance, generate, visibility, shade.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frame/frame_parts.h"
#include "frame/frame_watch.h"
#include "frame/readback.h"
#include "frame/seeds.h"

namespace vsglbench {

struct FrameTimes {
  std::vector<PassTime> passes;    // in order of first appearance, one entry a pass
  double span_ms = 0, sum_ms = 0;  // span: first to last timestamp, summed over submissions
  unsigned generate_dispatches = 0;
  uint64_t triangles = 0;  // drawn, into both halves
};

class Frame {
 public:
  // `exact` is called for Visibility::exact only. Throws Error(case_failed) for sizes the device can't take,
  // N = 0 or N > texels.
  Frame(Stage& stage, const MethodInfo& method, const Json& method_parameters,
        const FrameParameters& parameters, ExactVisibility exact);

  // Renders with the lattice shift of `seed`. Waits for the device. `watched`: with memory_fault(), and not
  // to be timed against a frame that is not.
  FrameTimes render(uint32_t seed, bool watched = false);
  // A frame of an animation, watched: what stands still is not drawn again. `carried`: what this seed's frame
  // before left there, and the next is to be given; null: nothing is carried.
  FrameTimes render_in_motion(uint32_t seed, Carried* carried);

  // Takes over what set_frame() moved, after Stage::follow(): every frame then gives the bits of a new one of
  // the same pose. KeptPdfs stay those of the pose that they were made in.
  void follow(const Moved& moved);

  // For timing generation alone. prepare() draws the halves, which then stand for every frame of these sizes,
  // and makes the PDFs with this frame's method; throws Error(case_failed) for one that uses none, and for
  // PDFs with a NaN or Inf. generate_only() runs nothing but the generate passes, on those halves and PDFs.
  KeptPdfs prepare(uint32_t seed);
  FrameTimes generate_only(uint32_t seed, const KeptPdfs& pdfs, bool watched = false);

  // Direct light of the current view, outside any timing.
  Image render_direct();

  // What the last render() made; lights and powers also of the last generate_only().
  const FrameReadback& results() const { return results_; }
  // The fault of the last watched frame: FrameWatch::fault().
  const std::string& memory_fault() const { return watch_.fault(); }
  // With check_passes: the first NaN or Inf that a pass of the last render() or generate_only() wrote,
  // whether or not it is still there at the end.
  std::optional<BadOutput> bad_output() const { return check_ ? check_->first_bad() : std::nullopt; }

  uint32_t light_count() const { return parts_.lights.count(); }
  LightKind light_kind() const { return parts_.lights.kind(); }
  LightShapes light_shapes() const { return parts_.generator.method().shapes(Half::rsm); }
  // What the method under test has asked for on the RSM.
  const MethodContext& method_context() const { return parts_.generator.context(); }
  bool uses_importance() const { return parts_.importance.has_value(); }
  // Kernels and scratch memory that the method asked for.
  size_t method_kernels() const;
  size_t method_bytes() const;
  // What a frame works with beside the scene: deferred targets, PDFs, lights, the method's scratch memory,
  // bits of visibility and the image; shadow maps are not counted.
  size_t memory_bytes() const;
  const EffectSet& effects() const { return parts_.parameters.effects; }  // what it simulates
  const DeferredTargets& gbuffer() const { return parts_.halves.targets(Half::gbuffer); }
  const DeferredTargets& rsm() const { return parts_.halves.targets(Half::rsm); }
  const gpu::Emitter& camera() const { return parts_.halves.emitter(Half::gbuffer); }
  const gpu::Emitter& light() const { return parts_.halves.emitter(Half::rsm); }

 private:
  struct Mode {
    bool watched = false;
    Halves::Motion motion = Halves::Motion::none;
    Carried* carried = nullptr;
  };
  FrameTimes render(uint32_t seed, const Mode& mode);
  // One set of lights and its share of the image. Iteration 0 draws the halves, too.
  void render_iteration(uint32_t seed, uint32_t iteration, const Mode& mode, FrameTimes* times);
  void restart();

  FrameParts parts_;
  FrameReadback results_{parts_};
  FrameWatch watch_{parts_};
  std::unique_ptr<PassCheck> check_;  // null without check_passes
  Recorder recorder_;
};

}  // namespace vsglbench
