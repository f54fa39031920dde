#include "frame/light_records.h"

#include <algorithm>

#include "frame/light_flux.h"

namespace vsglbench {

LightRecords read_lights(LightKind kind, const Buffer& buffer, size_t count, unsigned lobes) {
  const auto read = buffer.download<std::byte>(count * light_stride(kind, lobes));
  const std::vector<size_t> words = record_words(kind, lobes);
  const size_t whole = light_stride(kind);
  if (4 * words.size() == whole) return {kind, read};
  LightRecords lights{kind, std::vector<std::byte>(count * whole)};
  for (size_t i = 0; i < count; ++i) {
    for (size_t w = 0; w < words.size(); ++w)
      std::memcpy(&lights.bytes[i * whole + 4 * words[w]], &read[4 * (i * words.size() + w)], 4);
    // A BRDF without a specular lobe still has a width, as the kernels' vpl_surface() gives it.
    const float rough = 1;
    if (kind != LightKind::vsgl && !(lobes & SPECULAR_LOBE))
      std::memcpy(&lights.bytes[i * whole + offsetof(gpu::Vpl, ndf)], &rough, sizeof rough);
  }
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
