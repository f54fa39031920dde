#include "operation/shading_probe.h"

#include "base/file.h"

namespace vsglbench {
namespace {

template <class Record>
Buffer upload(Device& device, const std::vector<ShadingPair>& pairs, Record ShadingPair::*member) {
  std::vector<Record> records;
  for (const ShadingPair& pair : pairs) records.push_back(pair.*member);
  Buffer buffer(device, "records", records.size() * sizeof(Record));
  buffer.upload(std::span<const Record>(records));
  return buffer;
}

std::filesystem::path kernel_file(const char* name) { return data_root() / "harness" / "operation" / name; }

}  // namespace

std::vector<glm::vec4> ShadingProbe::shade(const std::vector<ShadingPair>& pairs, ProbeMode mode,
                                           ShaderDefines defines, float alpha, uint32_t runs) {
  struct Push {
    uint32_t count, runs;
    float alpha;
  };
  defines["MODE"] = std::to_string(static_cast<int>(mode));
  const Kernel& kernel = kernels_.get(kernel_file("approximation.comp"), defines);
  Device& device = recorder_.device();
  const auto count = static_cast<uint32_t>(pairs.size());
  const Buffer surfaces = upload(device, pairs, &ShadingPair::surface),
               lights = upload(device, pairs, &ShadingPair::light),
               texels = upload(device, pairs, &ShadingPair::texel);
  const Buffer values(device, "values", size_t{count} * runs * sizeof(glm::vec4));
  recorder_.begin();
  recorder_.pass({.step = "probe"}, [&] {
    recorder_.dispatch(kernel, {surfaces, lights, texels, values}, Push{count, runs, alpha},
                       groups_for(count * runs, 64));
  });
  recorder_.submit_and_wait();
  return values.download<glm::vec4>(size_t{count} * runs);
}

gpu::Vsgl ShadingProbe::light_of(const oracle::Half& half) {
  const Kernel& kernel = kernels_.get(kernel_file("approximation_emitter.comp"), {});
  const DeviceHalf on_device(recorder_.device(), half);
  const Field field = on_device.field(Half::rsm, false);
  const Buffer light(recorder_.device(), "light", sizeof(gpu::Vsgl));
  recorder_.begin();
  recorder_.pass({.step = "emitter"}, [&] {
    recorder_.dispatch(kernel, {field.maps, light}, half.emitter, 1);
  });
  recorder_.submit_and_wait();
  return light.download<gpu::Vsgl>(1)[0];
}

}  // namespace vsglbench
