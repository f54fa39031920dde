#include "frame/halves.h"

namespace vsglbench {

Halves::Halves(Stage& stage, uint32_t width, uint32_t height, uint32_t rsm, const EffectSet& effects)
    : stage_(stage), effects_(effects) {
  const auto make = [&](Half half, uint32_t w, uint32_t h) {
    Seen& seen = seen_[static_cast<size_t>(half)];
    seen.targets = &stage.targets(half, w, h, effects);
    seen.buffer = Buffer(stage.device, half == Half::gbuffer ? "camera" : "light", sizeof seen.emitter);
  };
  make(Half::gbuffer, width, height);
  make(Half::rsm, rsm, rsm);
  see_camera();
  see_light();
}

void Halves::see(Half half, const View& view, const glm::vec3& power) {
  Seen& seen = seen_[static_cast<size_t>(half)];
  seen.view = view;
  seen.emitter = make_emitter(view, seen.targets->width, seen.targets->height, power, half == Half::gbuffer);
  seen.buffer.upload(&seen.emitter, sizeof seen.emitter);
}

void Halves::see_camera() {
  const DeferredTargets& targets = *of(Half::gbuffer).targets;
  see(Half::gbuffer, camera_view(stage_.scene.camera, targets.width, targets.height), glm::vec3(1));
}

void Halves::see_light() { see(Half::rsm, light_view(stage_.scene.light), stage_.scene.light.power); }

void Halves::follow(const Moved& moved) {
  if (moved.camera) see_camera();
  if (moved.light) see_light();
}

bool Halves::moves(Half half) const {
  const Moved& moves = stage_.scene.animation.moves;
  return half == Half::gbuffer ? moves.camera : moves.light;
}

uint64_t Halves::draw(Recorder& recorder, Motion motion) const {
  uint64_t triangles = 0;
  for (const Half half : {Half::gbuffer, Half::rsm}) {
    const Seen& seen = of(half);
    const ShaderDefines defines = raster_permutation(effects_, half);
    const DeferredTargets* layer = nullptr;
    if (motion == Motion::frames && !moves(half))
      layer = &stage_.still_layers.get(half, seen.view, seen.buffer, *seen.targets, defines);
    recorder.pass({PassStage::draw, half, ""}, [&] {
      if (layer) copy_layer(recorder.commands(), *layer, *seen.targets);
      triangles += stage_.geometry.draw(recorder, seen.view, seen.buffer, *seen.targets, defines,
                                        layer ? SceneGpu::Part::moving : SceneGpu::Part::all);
    });
  }
  return triangles;
}

Field Halves::field(Half half, const Buffer* pdf) const {
  return {.half = half, .emitter = emitter(half), .maps = targets(half).field_maps(), .pdf = pdf};
}

}  // namespace vsglbench
