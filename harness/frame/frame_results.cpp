// What a frame left on the device, read back.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "frame/frame.h"
#include "frame/light_flux.h"
#include "method/filtered_sampling.h"

namespace vsglbench {
namespace {

bool all_finite(const float* begin, size_t count) {
  return std::all_of(begin, begin + count, [](float v) { return std::isfinite(v); });
}

// Without the fields that nobody reads, which a kernel need not write. The others are all floats.
gpu::Vsgl used(const gpu::Vsgl& light) { return light; }
gpu::Vpl used(gpu::Vpl light) {
  light.unused0 = light.unused1 = 0;
  return light;
}

template <class Light>
bool is_finite(const Light& whole) {
  const Light light = used(whole);
  return all_finite(reinterpret_cast<const float*>(&light), sizeof light / sizeof(float));
}

template <class Light>
bool all_finite(const std::vector<Light>& lights) {
  return std::all_of(lights.begin(), lights.end(), is_finite<Light>);
}

template <class Light>
void check(const std::vector<Light>& lights, const char* pass, LightHealth* health) {
  for (size_t i = 0; i < lights.size(); ++i) {
    if (is_finite(lights[i])) continue;
    const Light light = used(lights[i]);
    const float* fields = reinterpret_cast<const float*>(&light);
    const bool nan =
        std::any_of(fields, fields + sizeof light / sizeof(float), [](float v) { return std::isnan(v); });
    (nan ? health->nan : health->inf) += 1;
    if (health->first_bad_pass.empty()) {
      health->first_bad_pass = pass;
      health->first_bad = i;
    }
  }
}

// The half that a pass works on, by its name: "rsm", "generate.rsm.sort"; what shades works on the camera's.
std::optional<Half> half_of(const std::string& pass) {
  const size_t dot = pass.find('.');
  const std::string stage = pass.substr(0, dot);
  const std::string step =
      dot == std::string::npos ? "" : pass.substr(dot + 1, pass.find('.', dot + 1) - dot - 1);
  if (pass == "gbuffer" || pass == "shade" || pass == "direct") return Half::gbuffer;
  if (pass == "rsm") return Half::rsm;
  if (stage != "importance" && stage != "generate") return std::nullopt;
  return step == "gbuffer" ? Half::gbuffer : Half::rsm;
}

}  // namespace

std::vector<glm::vec4> download_map(const DeviceImage& image) {
  std::vector<glm::vec4> texels(size_t(image.width()) * image.height());
  image.download(texels.data(), texels.size() * sizeof(glm::vec4));
  return texels;
}

std::vector<LightPoint> Frame::light_points() const {
  std::vector<LightPoint> points;
  const float tolerance = kVisibilityTolerance * stage_.scene.diagonal();
  for (const auto& light : vsgls()) {
    const float sigma = std::sqrt(light.variance);
    points.push_back({light.mean, clears_sigma() ? sigma : std::min(sigma, tolerance)});
  }
  for (const auto& light : vpls()) points.push_back({light.position, 0});
  return points;
}

Image Frame::indirect() const {
  Image image(camera_.width, camera_.height);
  const auto texels = stage_.scratch.get("indirect", image.pixels.size() * sizeof(glm::vec4))
                          .download<glm::vec4>(image.pixels.size());
  std::transform(texels.begin(), texels.end(), image.pixels.begin(),
                 [](const glm::vec4& t) { return glm::vec3(t); });
  return image;
}

ShadingNotes Frame::shading_notes() const {
  ShadingNotes notes;
  const size_t pixels = size_t(camera_.width) * camera_.height;
  const auto shaded = stage_.scratch.get("indirect", pixels * sizeof(glm::vec4)).download<glm::vec4>(pixels);
  const auto lights = vpls();
  const bool clamped = std::any_of(lights.begin(), lights.end(), [](const auto& l) { return l.clamp > 0; });
  if (clamped) {
    double removed = 0, kept = 0;
    for (const glm::vec4& s : shaded) {
      removed += s.a;
      kept += glm::dot(glm::dvec3(s), glm::dvec3(0.2126, 0.7152, 0.0722));
    }
    notes.clamp_removed = removed > 0 ? removed / (removed + kept) : 0;
  }
  if (method_->kind() != LightKind::vsgl || parameters_.bias_reduction == 0) return notes;
  const auto all = vsgls();
  const auto powered = std::count_if(all.begin(), all.end(), [](const auto& l) { return l.power > 0; });
  const auto mask = surface_mask();
  Image rate(camera_.width, camera_.height);
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

std::vector<uint8_t> Frame::surface_mask() const {
  const auto position = download_map(gbuffer_->maps[0]);
  std::vector<uint8_t> mask(position.size());
  std::transform(position.begin(), position.end(), mask.begin(), [](const glm::vec4& p) { return p.w > 0; });
  return mask;
}

std::vector<gpu::Vsgl> Frame::vsgls() const {
  if (method_->kind() != LightKind::vsgl) return {};
  return light_buffer(Half::rsm).download<gpu::Vsgl>(light_count_);
}

std::vector<gpu::Vpl> Frame::vpls() const {
  if (method_->kind() == LightKind::vsgl) return {};
  return light_buffer(Half::rsm).download<gpu::Vpl>(light_count_);
}

std::vector<float> Frame::importance() const {
  if (!uses_importance()) return {};
  return const_cast<Frame*>(this)->pdf_buffer(Half::rsm).download<float>(size_t(light_.width) *
                                                                         light_.height);
}

std::string Frame::first_bad_pass() const {
  const auto bad_maps = [&](const DeferredTargets& targets) {
    return std::any_of(targets.maps.begin(), targets.maps.end(), [&](const DeviceImage& map) {
      const auto texels = download_map(map);
      return !all_finite(&texels.front().x, 4 * texels.size());
    });
  };
  if (bad_maps(*gbuffer_)) return "gbuffer";
  if (bad_maps(*rsm_)) return "rsm";
  if (const auto p = importance(); !all_finite(p.data(), p.size())) return "importance.rsm";
  if (!all_finite(vsgls()) || !all_finite(vpls())) return "generate.rsm";
  const Image image = indirect();
  return all_finite(&image.pixels.front().x, 3 * image.pixels.size()) ? "" : "shade";
}

FrameOutputs::NamedBuffer Frame::named_output(const std::string& pass, const Buffer& buffer) {
  const std::optional<Half> half = half_of(pass);
  const auto is = [&](const Buffer& b) { return &b == &buffer; };
  if (half && pass.starts_with("importance.") && is(pdf_buffer(*half))) {
    const DeferredTargets& t = *half == Half::gbuffer ? *gbuffer_ : *rsm_;
    return {fmt::format("pdf.{}", half_name(*half)), pyramid_texels(t.width, t.height) * sizeof(float)};
  }
  if (half && pass.starts_with("generate.")) {
    const bool other = *half == Half::gbuffer && other_method_;
    const uint32_t count = *half == Half::gbuffer ? importance_count_ : light_count_;
    const size_t stride = light_stride((other ? *other_method_ : *method_).kind());
    if (is(light_buffer(*half))) return {fmt::format("lights.{}", half_name(*half)), count * stride, true};
    for (const auto& [name, bytes] : (other ? *other_context_ : context_).scratch_buffers()) {
      if (is(stage_.scratch.get(name, 0))) return {name, bytes};
    }
  }
  if (pass == "shade") return {"indirect", size_t(camera_.width) * camera_.height * sizeof(glm::vec4)};
  return {"", buffer.size()};
}

FrameOutputs Frame::outputs() {
  FrameOutputs out;
  out.buffer = [this](const std::string& pass, const Buffer& buffer) { return named_output(pass, buffer); };
  out.half = [this](const std::string& pass) -> FrameOutputs::HalfSize {
    const std::optional<Half> half = half_of(pass);
    if (!half) return {};
    if (*half == Half::gbuffer) return {{gbuffer_->width, gbuffer_->height}, importance_count_};
    return {{rsm_->width, rsm_->height}, light_count_};
  };
  out.targets = [this](const std::string& pass) -> const DeferredTargets* {
    return pass == "gbuffer" ? gbuffer_ : pass == "rsm" ? rsm_ : nullptr;
  };
  return out;
}

double Frame::light_power() const {
  double sum = 0;
  for (const auto& light : vsgls()) sum += reflected_power(light);
  for (const auto& light : vpls()) sum += reflected_power(light);
  return sum;
}

double Frame::texel_power() const {
  std::array<std::vector<glm::vec4>, 5> maps;
  std::transform(rsm_->maps.begin(), rsm_->maps.end(), maps.begin(), download_map);
  return reflected_power(light_, maps);
}

bool Frame::has_importance() const {
  const auto p = importance();
  return !uses_importance() || std::any_of(p.begin(), p.end(), [](float v) { return v > 0; });
}

// What a kernel of the method can reach: both halves' lights, the method's own scratch memory and the PDFs.
void Frame::arm_memory() {
  const auto arm = [&](const std::string& name, size_t bytes, bool contents) {
    // To the end of what the pool gave, which may be more: a method may clear all of it.
    Buffer& buffer = stage_.scratch.get(name, bytes);
    memory_.arm(name, buffer, buffer.size(), contents);
  };
  const auto arm_half = [&](Half half, const Method& method, uint32_t count) {
    const std::string name = half_name(half);
    memory_.arm("lights." + name, light_buffer(half), count * light_stride(method.kind()), true);
    const DeferredTargets& t = half == Half::gbuffer ? *gbuffer_ : *rsm_;
    if (uses_importance()) arm("pdf." + name, pyramid_texels(t.width, t.height) * sizeof(float), false);
  };
  if (lights_gbuffer()) arm_half(Half::gbuffer, importance_method(), importance_count_);
  arm_half(Half::rsm, *method_, light_count_);
  auto scratch = context_.largest_scratch();
  if (other_context_) {
    for (const auto& [name, bytes] : other_context_->largest_scratch())
      scratch[name] = std::max(scratch[name], bytes);
  }
  for (const auto& [name, bytes] : scratch) arm(name, bytes, true);
}

// The first fault stays.
void Frame::look_at_memory() {
  const std::string overrun = memory_.overrun();
  std::string fault = lights_gbuffer() ? unwritten_lights(Half::gbuffer) : "";
  if (fault.empty()) fault = unwritten_lights(Half::rsm);
  if (!overrun.empty()) fault += fmt::format("{}{} was written", fault.empty() ? "" : ", and ", overrun);
  if (memory_fault_.empty()) memory_fault_ = fault;
}

std::string Frame::unwritten_lights(Half half) const {
  const bool gbuffer = half == Half::gbuffer;
  const uint32_t count = gbuffer ? importance_count_ : light_count_;
  const size_t stride = light_stride((gbuffer ? importance_method() : *method_).kind()) / 4;
  const bool is_vpl = stride == sizeof(gpu::Vpl) / 4;
  const std::vector<size_t> unused = {offsetof(gpu::Vpl, unused0) / 4, offsetof(gpu::Vpl, unused1) / 4};
  const Unwritten found = find_unwritten(light_buffer(half).download<uint32_t>(count * stride), stride,
                                         is_vpl ? unused : std::vector<size_t>());
  if (found.records == 0) return "";
  if (found.records < count)
    return fmt::format("{} of {} lights of generate.{} were not written, the first is light {}",
                       found.records, count, half_name(half), found.first);
  return fmt::format("none of the {} lights of generate.{} was written", count, half_name(half));
}

LightHealth Frame::light_health() const {
  LightHealth health;
  const auto check_half = [&](Half half, const Method& method, uint32_t count, const char* pass) {
    const Buffer& lights = light_buffer(half);
    if (method.kind() == LightKind::vsgl) {
      check(lights.download<gpu::Vsgl>(count), pass, &health);
    } else {
      check(lights.download<gpu::Vpl>(count), pass, &health);
    }
  };
  if (lights_gbuffer()) check_half(Half::gbuffer, importance_method(), importance_count_, "generate.gbuffer");
  check_half(Half::rsm, *method_, light_count_, "generate.rsm");
  return health;
}

}  // namespace vsglbench
