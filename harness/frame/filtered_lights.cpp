#include "frame/filtered_lights.h"

#include <cstring>

#include "frame/permutation.h"
#include "frame/stage.h"

namespace vsglbench {
namespace {

// Words of FilteredLight: what every kernel's has, and those of each lobe.
constexpr size_t kCommon = 7, kDiffuse = 3, kSpecular = 10;

}  // namespace

bool is_filtered(LightKind kind, const Shading& shading) {
  return info_of(kind).reads_shading && chosen(shading, "shading") == "filtered";
}

size_t filtered_light_stride(unsigned lobes) {
  return sizeof(float) *
         (kCommon + (lobes & DIFFUSE_LOBE ? kDiffuse : 0) + (lobes & SPECULAR_LOBE ? kSpecular : 0));
}

void record_filtered_lights(Recorder& recorder, KernelLibrary& kernels, const Field& rsm,
                            const Shading& shading, const ShaderDefines& effects, const Buffer& lights,
                            uint32_t count, const Buffer& filtered) {
  const struct {
    gpu::Emitter emitter;
    uint32_t count;
  } push{rsm.emitter, count};
  const Kernel& kernel =
      kernels.get(frame_kernel("filtered_lights.comp"), merged(shading_defines(shading), effects));
  recorder.dispatch(kernel, {rsm.maps, lights, filtered}, push, groups_for(count, 64));
}

std::vector<gpu::FilteredLight> read_filtered_lights(const Buffer& filtered, size_t count, unsigned lobes) {
  const size_t stride = filtered_light_stride(lobes);
  const auto bytes = filtered.download<std::byte>(count * stride);
  std::vector<gpu::FilteredLight> lights(count);
  for (size_t i = 0; i < count; ++i) {
    const std::byte* at = &bytes[i * stride];
    const auto take = [&](void* field, size_t words) {
      std::memcpy(field, at, words * sizeof(float));
      at += words * sizeof(float);
    };
    gpu::FilteredLight& l = lights[i];
    l.ndf = 1;
    take(&l.mean, 3);
    take(&l.variance, 1);
    take(&l.normal, 3);
    if (lobes & DIFFUSE_LOBE) take(&l.diffuse, kDiffuse);
    if (lobes & SPECULAR_LOBE) take(&l.ndf, kSpecular);
  }
  return lights;
}

}  // namespace vsglbench
