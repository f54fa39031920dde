#include "frame/halves.h"

namespace vsglbench {

Halves::Halves(Stage& stage, uint32_t width, uint32_t height, uint32_t rsm, const EffectSet& effects)
    : stage_(stage), effects_(effects) {
  const auto see = [&](Half half, const View& view, uint32_t w, uint32_t h, const glm::vec3& power) {
    Seen& seen = seen_[static_cast<size_t>(half)];
    seen.view = view;
    seen.targets = &stage.targets(half, w, h, effects);
    seen.emitter = make_emitter(view, w, h, power, half == Half::gbuffer);
    seen.buffer = Buffer(stage.device, half == Half::gbuffer ? "camera" : "light", sizeof seen.emitter);
    seen.buffer.upload(&seen.emitter, sizeof seen.emitter);
  };
  see(Half::gbuffer, camera_view(stage.scene.camera, width, height), width, height, glm::vec3(1));
  see(Half::rsm, light_view(stage.scene.light), rsm, rsm, stage.scene.light.power);
}

void Halves::draw(Recorder& recorder) const {
  for (const Half half : {Half::gbuffer, Half::rsm}) {
    recorder.pass({PassStage::draw, half, ""}, [&] {
      stage_.geometry.draw(recorder, of(half).view, of(half).buffer, *of(half).targets,
                           raster_permutation(effects_, half));
    });
  }
}

Field Halves::field(Half half, const Buffer* pdf) const {
  return {.half = half, .emitter = emitter(half), .maps = targets(half).field_maps(), .pdf = pdf};
}

}  // namespace vsglbench
