#include "stability/made_shading.h"

#include <algorithm>

#include "frame/shade_pass.h"

namespace vsglbench {

std::vector<glm::vec3> MadeShading::shade(const oracle::Half& receivers, const LightRecords& lights,
                                          const Shading& shading) {
  ShaderDefines defines = shade_defines(lights.kind, shading);
  defines["VISIBILITY"] = "0";
  const Kernel& kernel = kernels_.get(frame_kernel("shade.comp"), defines);
  const DeviceHalf texels(kernels_.device(), receivers);
  const Field field = texels.field(Half::gbuffer);
  Buffer light_buffer(kernels_.device(), "lights", lights.bytes.size());
  light_buffer.upload(lights.bytes.data(), lights.bytes.size());
  const Buffer out(kernels_.device(), "radiance", receivers.texels.size() * sizeof(glm::vec4));
  const ShadePush push{.emitter = field.emitter, .count = static_cast<uint32_t>(lights.count())};
  recorder_.begin();
  recorder_.pass({.stage = PassStage::shade}, [&] {
    recorder_.dispatch(kernel, {field.maps, light_buffer, out}, push, groups_for(field.emitter.width, 8),
                       groups_for(field.emitter.height, 32));
  });
  recorder_.submit_and_wait();
  const auto raw = out.download<glm::vec4>(receivers.texels.size());
  std::vector<glm::vec3> radiance(raw.size());
  std::ranges::transform(raw, radiance.begin(), [](const glm::vec4& v) { return glm::vec3(v); });
  return radiance;
}

}  // namespace vsglbench
