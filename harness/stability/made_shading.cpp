#include "stability/made_shading.h"

#include "frame/filtered_lights.h"
#include "frame/shade_pass.h"

namespace vsglbench {

MadeShading::Shaded MadeShading::shade(const oracle::Half& receivers, const DeviceHalf& rsm,
                                       const LightRecords& lights, const Shading& shading) {
  constexpr unsigned kBoth = DIFFUSE_LOBE | SPECULAR_LOBE;
  const bool filters = is_filtered(lights.kind, shading);
  ShaderDefines defines = shade_defines(lights.kind, shading);
  defines["VISIBILITY"] = "0";
  if (filters) defines["LIGHT_FILTERED"] = "1";
  const Kernel& kernel = kernels_.get(frame_kernel("shade.comp"), defines);
  const DeviceHalf surfaces(kernels_.device(), receivers);
  const Field field = surfaces.field(Half::gbuffer);
  const auto count = static_cast<uint32_t>(lights.count());
  Buffer light_buffer(kernels_.device(), "lights", lights.bytes.size());
  light_buffer.upload(lights.bytes.data(), lights.bytes.size());
  const Buffer out(kernels_.device(), "radiance", receivers.texels.size() * sizeof(glm::vec4)),
      filtered(kernels_.device(), "filtered lights", count * filtered_light_stride(kBoth));
  const ShadePush push{.emitter = field.emitter, .count = count};
  recorder_.begin();
  recorder_.pass({.stage = PassStage::shade}, [&] {
    if (filters) {
      record_filtered_lights(recorder_, kernels_, rsm.field(Half::rsm, false), shading, {}, light_buffer,
                             count, filtered);
      recorder_.barrier();
    }
    recorder_.dispatch(kernel, {field.maps, filters ? filtered : light_buffer, out}, push,
                       groups_for(field.emitter.width, 8), groups_for(field.emitter.height, 32));
  });
  recorder_.submit_and_wait();
  Shaded shaded;
  for (const glm::vec4& v : out.download<glm::vec4>(receivers.texels.size())) shaded.radiance.emplace_back(v);
  if (filters) shaded.filtered = read_filtered_lights(filtered, count, kBoth);
  return shaded;
}

}  // namespace vsglbench
