#include "frame/half_lights.h"

#include "frame/checked_method.h"

namespace vsglbench {

LightGenerator::LightGenerator(Stage& stage, const MethodInfo& info, const Json& parameters,
                               const Shading& shading, const EffectSet& effects, Half half)
    : name_(info.name),
      context_(stage.kernels, stage.scratch, info.folder,
               merged(shading_defines(shading), permutation(effects, half, half)), lobes_of(effects, half)),
      method_(make_method(info, context_, parameters)) {}

HalfLights::HalfLights(Stage& stage, const Halves& halves, const LightGenerator& generator, Half half,
                       uint32_t wanted)
    : stage_(stage),
      halves_(halves),
      generator_(generator),
      half_(half),
      count_(light_count_of(generator.method(), generator.name(), wanted, halves.texels(half))) {}

unsigned HalfLights::generate(Recorder& recorder, const Buffer* pdf, glm::uvec2 shift,
                              CarriedLights* carried) const {
  const unsigned before = recorder.dispatches();
  Steps steps(recorder, half_);
  Method& method = generator_.method();
  CarriedState state;
  if (carried) state = carried->next(stage_.device, half_, method.carried_bytes(count_));
  method.generate(steps, halves_.field(half_, pdf), {&buffer(), count_, shift, state});
  return recorder.dispatches() - before;
}

const Buffer& HalfLights::buffer() const {
  return stage_.memory.lights[static_cast<size_t>(half_)][bytes()].get(
      stage_.device, fmt::format("lights.{}", half_name(half_)), bytes());
}

ShaderDefines light_defines(LightKind kind, const Shading& shading) {
  const LightKindInfo& info = info_of(kind);
  ShaderDefines defines = info.reads_shading ? shading_defines(shading) : ShaderDefines{};
  defines.insert(info.record_defines.begin(), info.record_defines.end());
  return defines;
}

}  // namespace vsglbench
