#include "frame/light_records.h"

#include <algorithm>

#include "frame/light_flux.h"

namespace vsglbench {

LightRecords read_lights(LightKind kind, const Buffer& buffer, size_t count) {
  LightRecords lights{kind, buffer.download<std::byte>(count * light_stride(kind))};
  return lights;
}

LightSummary summary_of(const gpu::Vsgl& light) {
  LightSummary s{.position = light.mean, .variance = light.variance, .power = light.power};
  s.carried = s.reflected = reflected_power(light);
  s.color = glm::vec3(lobe_power(light));
  return s;
}

LightSummary summary_of(const gpu::Vpl& light) {
  return {.position = light.position,
          .radius = light.radius,
          .power = light.power,
          .carried = incident_power(light),
          .reflected = reflected_power(light),
          .color = light.flux * (light.diffuse + light.f0),
          .clamped = light.clamp > 0};
}

std::vector<LightSummary> summaries_of(const LightRecords& lights) {
  std::vector<LightSummary> out;
  lights.each([&](size_t, const auto& light) { out.push_back(summary_of(light)); });
  return out;
}

uint64_t count_without_power(const LightRecords& lights) {
  uint64_t count = 0;
  lights.each([&](size_t, const auto& light) { count += light.power > 0 ? 0 : 1; });
  return count;
}

std::vector<float> floats_of(const LightRecords& lights, size_t i) {
  const LightKindInfo& info = info_of(lights.kind);
  std::vector<float> words(info.bytes / sizeof(float));
  std::memcpy(words.data(), &lights.bytes[i * info.bytes], info.bytes);
  for (const size_t word : info.unused) words[word] = 0;
  return words;
}

}  // namespace vsglbench
