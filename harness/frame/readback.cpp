#include "frame/readback.h"

#include <algorithm>
#include <cmath>

#include "frame/light_flux.h"

namespace vsglbench {
namespace {

bool all_finite(const float* begin, size_t count) {
  return std::all_of(begin, begin + count, [](float v) { return std::isfinite(v); });
}

bool all_finite(const DeferredTargets& targets) {
  return std::ranges::all_of(targets.maps, [](const DeviceImage& map) {
    if (!map) return true;
    const auto texels = download_map(map);
    return all_finite(&texels.front().x, 4 * texels.size());
  });
}

// One light, or one texel: a NaN counts before an Inf.
void count(std::span<const float> values, uint64_t index, std::optional<BadValues>* bad) {
  if (all_finite(values.data(), values.size())) return;
  if (!*bad) bad->emplace().first = index;
  const bool nan = std::ranges::any_of(values, [](float v) { return std::isnan(v); });
  (nan ? (*bad)->nan : (*bad)->inf) += 1;
}

std::optional<BadValues> bad_lights(const HalfLights* lights) {
  std::optional<BadValues> bad;
  if (!lights) return bad;
  const LightRecords records = lights->read();
  for (size_t i = 0; i < records.count(); ++i) count(floats_of(records, i), i, &bad);
  if (bad) bad->pass = {PassStage::generate, lights->half(), ""};
  return bad;
}

std::optional<BadValues> bad_texels(const std::vector<float>& pdf, uint32_t width) {
  std::optional<BadValues> bad;
  for (size_t i = 0; i < pdf.size(); ++i) count({&pdf[i], 1}, i, &bad);
  if (!bad) return bad;
  bad->pass = {PassStage::importance, Half::rsm, ""};
  bad->are_lights = false;
  bad->texel = {bad->first % width, bad->first / width};
  return bad;
}

glm::vec3 rgb(const glm::vec4& v) { return glm::vec3(v); }

}  // namespace

std::string BadValues::message() const {
  if (are_lights)
    return fmt::format("{} lights with a NaN and {} with an Inf, the first is light {} of {}", nan, inf,
                       first, pass);
  return fmt::format("{} texels of the PDF with a NaN and {} with an Inf, the first is texel ({}, {}) of {}",
                     nan, inf, texel.x, texel.y, pass);
}

std::vector<glm::vec4> download_map(const DeviceImage& image) {
  std::vector<glm::vec4> texels(size_t(image.width()) * image.height());
  image.download(texels.data(), texels.size() * sizeof(glm::vec4));
  return texels;
}

Image FrameReadback::indirect() const {
  const gpu::Emitter& camera = parts_.halves.emitter(Half::gbuffer);
  Image image(camera.width, camera.height);
  const auto texels = parts_.shade.indirect().download<glm::vec4>(image.pixels.size());
  std::ranges::transform(texels, image.pixels.begin(), rgb);
  return image;
}

ShadingNotes FrameReadback::shading_notes() const {
  ShadingNotes notes;
  const gpu::Emitter& camera = parts_.halves.emitter(Half::gbuffer);
  const size_t pixels = size_t(camera.width) * camera.height;
  const auto shaded = parts_.shade.indirect().download<glm::vec4>(pixels);
  const auto lights_seen = summaries_of(lights());
  if (std::ranges::any_of(lights_seen, &LightSummary::clamped)) {
    double removed = 0, kept = 0;
    for (const glm::vec4& s : shaded) {
      removed += s.a;
      kept += glm::dot(glm::dvec3(s), glm::dvec3(0.2126, 0.7152, 0.0722));
    }
    notes.clamp_removed = removed > 0 ? removed / (removed + kept) : 0;
  }
  if (!parts_.shade.reduces_bias()) return notes;
  const auto powered = std::ranges::count_if(lights_seen, [](const auto& l) { return l.power > 0; });
  const auto mask = surface_mask();
  Image rate(camera.width, camera.height);
  double sum = 0;
  for (size_t i = 0; i < pixels; ++i) {
    rate.pixels[i] = glm::vec3(powered > 0 ? shaded[i].a / static_cast<float>(powered) : 0);
    sum += rate.pixels[i].r;
  }
  const auto seen = std::count(mask.begin(), mask.end(), 1);
  notes.cancellation_rate = seen > 0 ? sum / static_cast<double>(seen) : 0;
  notes.cancellation = std::move(rate);
  return notes;
}

std::vector<uint8_t> FrameReadback::surface_mask() const {
  const auto position = download_map(*parts_.halves.targets(Half::gbuffer).field_maps().position);
  std::vector<uint8_t> mask(position.size());
  std::ranges::transform(position, mask.begin(), [](const glm::vec4& p) { return p.w > 0; });
  return mask;
}

std::vector<float> FrameReadback::importance() const {
  return parts_.importance ? parts_.importance->read(Half::rsm) : std::vector<float>();
}

double FrameReadback::light_power() const {
  double sum = 0;
  for (const LightSummary& light : summaries_of(lights())) sum += light.reflected;
  return sum;
}

double FrameReadback::texel_power() const {
  std::array<std::vector<glm::vec4>, 5> maps;
  const DeferredTargets& targets = parts_.halves.targets(Half::rsm);
  for (size_t k = 0; k < maps.size(); ++k) {
    maps[k] = targets.maps[k] ? download_map(targets.maps[k])
                              : std::vector<glm::vec4>(parts_.halves.texels(Half::rsm));
  }
  return reflected_power(parts_.halves.emitter(Half::rsm), maps);
}

bool FrameReadback::has_importance() const {
  const auto p = importance();
  return !parts_.importance || std::ranges::any_of(p, [](float v) { return v > 0; });
}

std::optional<BadValues> FrameReadback::bad_importance() const {
  if (auto bad = bad_lights(parts_.importance_lights())) return bad;
  // Kept PDFs were looked at when they were made.
  if (!parts_.importance || !parts_.importance->drawn_from_own()) return std::nullopt;
  return bad_texels(importance(), parts_.halves.emitter(Half::rsm).width);
}

std::optional<BadValues> FrameReadback::bad_values() const {
  const auto lights = bad_lights(&parts_.lights);
  auto first = bad_importance();
  if (!first) return lights;
  if (first->are_lights && lights) {
    first->nan += lights->nan;
    first->inf += lights->inf;
  }
  return first;
}

std::optional<PassId> FrameReadback::first_bad_pass() const {
  for (const Half half : {Half::gbuffer, Half::rsm}) {
    if (!all_finite(parts_.halves.targets(half))) return PassId{PassStage::draw, half, ""};
  }
  if (const auto bad = bad_values()) return bad->pass;
  const Image image = indirect();
  if (all_finite(&image.pixels.front().x, 3 * image.pixels.size())) return std::nullopt;
  return PassId{PassStage::shade, std::nullopt, ""};
}

}  // namespace vsglbench
