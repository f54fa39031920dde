#include "stability/made_shading.h"

#include <algorithm>

#include "base/file.h"
#include "frame/frame.h"

namespace vsglbench {

std::vector<glm::vec3> MadeShading::shade(const oracle::Half& receivers, const LightRecords& lights,
                                          const Shading& shading) {
  const bool vsgl = lights.kind == LightKind::vsgl;
  ShaderDefines defines = vsgl ? shading_defines(shading) : ShaderDefines{};
  defines["LIGHT_VPL"] = vsgl ? "0" : "1";
  if (lights.kind == LightKind::vsl) defines["LIGHT_VSL"] = "1";
  defines["VISIBILITY"] = "0";
  const Kernel& kernel = kernels_.get(data_root() / "harness" / "frame" / "shade.comp", defines);
  const DeviceHalf texels(kernels_.device(), receivers);
  const Field field = texels.field(Half::gbuffer);
  Buffer light_buffer(kernels_.device(), "lights", lights.bytes.size());
  light_buffer.upload(lights.bytes.data(), lights.bytes.size());
  const Buffer out(kernels_.device(), "radiance", receivers.texels.size() * sizeof(glm::vec4));
  const ShadePush push{.emitter = field.emitter, .count = static_cast<uint32_t>(lights.count())};
  recorder_.begin();
  recorder_.pass("shade", [&] {
    const auto& m = field.maps;
    recorder_.dispatch(kernel, {*m[0], *m[1], *m[2], *m[3], *m[4], light_buffer, out}, push,
                       groups_for(field.emitter.width, 8), groups_for(field.emitter.height, 8));
  });
  recorder_.submit_and_wait();
  const auto raw = out.download<glm::vec4>(receivers.texels.size());
  std::vector<glm::vec3> radiance(raw.size());
  std::ranges::transform(raw, radiance.begin(), [](const glm::vec4& v) { return glm::vec3(v); });
  return radiance;
}

}  // namespace vsglbench
