#include "frame/shade_pass.h"

#include <algorithm>
#include <cmath>

#include "frame/filtered_lights.h"
#include "frame/light_ranges.h"
#include "frame/seeds.h"

namespace vsglbench {

ShaderDefines shade_defines(LightKind kind, const Shading& shading) {
  ShaderDefines defines = light_defines(kind, shading);
  const LightKindInfo& info = info_of(kind);
  defines.insert(info.shading_defines.begin(), info.shading_defines.end());
  return defines;
}

ShadePass::ShadePass(Stage& stage, const Halves& halves, const HalfLights& lights,
                     const FrameParameters& parameters, ExactVisibility exact)
    : stage_(stage), halves_(halves), lights_(lights), parameters_(parameters), exact_(std::move(exact)) {}

const Buffer& ShadePass::indirect() const {
  return stage_.memory.indirect.get(stage_.device, "indirect",
                                    halves_.texels(Half::gbuffer) * sizeof(glm::vec4));
}

const Buffer& ShadePass::shaded() const {
  if (parameters_.interleave == 1) return indirect();
  return stage_.memory.shares.get(stage_.device, "shares", halves_.texels(Half::gbuffer) * sizeof(glm::vec4));
}

bool ShadePass::reduces_bias() const {
  return lights_.kind() == LightKind::vsgl && parameters_.bias_reduction > 0 && !filters();
}

bool ShadePass::filters() const { return is_filtered(lights_.kind(), parameters_.shading); }

bool ShadePass::needs_light_texels() const {
  if (lights_.kind() != LightKind::vsgl) return false;
  return parameters_.bias_reduction > 0 || shading_defines(parameters_.shading).contains("LOBE_FILTER");
}

std::vector<LightPoint> ShadePass::light_points() const {
  std::vector<LightPoint> points;
  const float tolerance = kVisibilityTolerance * stage_.scene.diagonal();
  for (const LightSummary& light : summaries_of(lights_.read())) {
    const float sigma = std::sqrt(light.variance);
    points.push_back({light.position, clears_sigma() ? sigma : std::min(sigma, tolerance)});
  }
  return points;
}

void ShadePass::trace() {
  auto points = light_points();
  const auto same = [](const LightPoint& a, const LightPoint& b) {
    return a.position == b.position && a.stop_short == b.stop_short;
  };
  if (std::equal(points.begin(), points.end(), traced_.begin(), traced_.end(), same)) return;
  bits_ = exact_(points);
  traced_ = std::move(points);
}

const Buffer& ShadePass::light_texels(Recorder& r) const {
  const Buffer& texels = stage_.memory.light_texels.get(
      stage_.device, "light texels", lights_.count() * light_stride(LightKind::vpl, lights_.lobes()));
  const Field rsm = halves_.field(Half::rsm, nullptr);
  r.pass({PassStage::shade, std::nullopt, "texels"}, [&] {
    const struct {
      gpu::Emitter emitter;
      uint32_t count;
    } push{rsm.emitter, lights_.count()};
    r.dispatch(stage_.kernels.get(frame_kernel("light_texels.comp"),
                                  merged(shading_defines(parameters_.shading),
                                         permutation(parameters_.effects, Half::rsm, Half::rsm))),
               {rsm.maps, lights_.buffer(), texels}, push, groups_for(lights_.count(), 64));
  });
  return texels;
}

const Buffer& ShadePass::filtered_lights() const {
  return stage_.memory.filtered_lights.get(stage_.device, "filtered lights",
                                           lights_.count() * filtered_light_stride(lights_.lobes()));
}

std::vector<gpu::FilteredLight> ShadePass::read_filtered_lights() const {
  if (!filters()) return {};
  return vsglbench::read_filtered_lights(filtered_lights(), lights_.count(), lights_.lobes());
}

void ShadePass::filter_lights(Recorder& r) const {
  r.pass({PassStage::shade, std::nullopt, "filter"}, [&] {
    record_filtered_lights(r, stage_.kernels, halves_.field(Half::rsm, nullptr), parameters_.shading,
                           permutation(parameters_.effects, Half::rsm, Half::rsm), lights_.buffer(),
                           lights_.count(), filtered_lights());
  });
}

void ShadePass::record(Recorder& r, uint32_t seed, uint32_t iteration) {
  const Field camera = halves_.field(Half::gbuffer, nullptr);
  ShaderDefines defines = merged(shade_defines(lights_.kind(), parameters_.shading),
                                 permutation(parameters_.effects, Half::gbuffer, Half::rsm));
  // All kinds of shadow maps are read alike.
  defines["VISIBILITY"] = std::to_string(static_cast<int>(std::min(parameters_.visibility, Visibility::ism)));
  if (reduces_bias()) defines["BIAS_REDUCTION"] = "1";
  const uint32_t block = parameters_.interleave;
  if (block > 1) defines["INTERLEAVE"] = fmt::format("{}u", block);
  ShadePush push{.emitter = camera.emitter,
                 .words = groups_for(camera.texels(), 32),
                 .map_size = parameters_.ism.size,
                 .random = static_cast<uint32_t>(mix(uint64_t(seed) << 32 | iteration)),
                 .radius2_scale = std::pow(4.0f / 9.0f, static_cast<float>(iteration)),
                 .weight = 1.0f / static_cast<float>(parameters_.progressive),
                 .alpha = parameters_.bias_reduction};
  if (filters()) defines["LIGHT_FILTERED"] = "1";
  Bindings bound = {camera.maps, filters() ? filtered_lights() : lights_.buffer(), shaded()};
  if (needs_light_texels()) {
    const Buffer& texels = light_texels(r);
    if (reduces_bias()) bound.add(texels);
  }
  if (filters()) filter_lights(r);
  const Kernel& kernel = stage_.kernels.get(frame_kernel("shade.comp"), defines);
  const Sight sight = see(r, &push, &bound);
  r.pass({PassStage::shade, std::nullopt, ""}, [&] {
    for (const LightRange& range : light_ranges(lights_.count(), sight.most_lights)) {
      push.first = range.first;
      push.count = range.count;
      push.accumulate = range.first > 0 || iteration > 0;
      if (range.first > 0) r.barrier();
      Bindings with_bits = bound;
      if (!sight.bits.empty()) with_bits.add(*sight.bits[range.first / sight.most_lights]);
      r.dispatch(kernel, with_bits, push, groups_for(camera.emitter.width, 8 * block),
                 groups_for(camera.emitter.height, 32 * block), block * block);
    }
  });
  if (block > 1 && iteration + 1 == parameters_.progressive) join(r);
}

void ShadePass::join(Recorder& r) const {
  const Field camera = halves_.field(Half::gbuffer, nullptr);
  ShaderDefines defines = permutation(parameters_.effects, Half::gbuffer, Half::rsm);
  defines["INTERLEAVE"] = fmt::format("{}u", parameters_.interleave);
  r.pass({PassStage::shade, std::nullopt, "join"}, [&] {
    r.dispatch(stage_.kernels.get(frame_kernel("join.comp"), defines), {camera.maps, shaded(), indirect()},
               camera.emitter, groups_for(camera.emitter.width, 8), groups_for(camera.emitter.height, 8));
  });
}

ShadePass::Sight ShadePass::see(Recorder& r, ShadePush* push, Bindings* bound) const {
  if (parameters_.visibility == Visibility::exact) return upload_bits(push->words);
  if (has_shadow_maps(parameters_.visibility)) {
    const auto maps = stage_.shadow_maps(parameters_.visibility, parameters_.ism)
                          .build(r, lights_.buffer(), lights_.kind(), lights_.count(),
                                 halves_.targets(Half::gbuffer), clears_sigma(), lights_.lobes());
    push->map_tolerance = maps.tolerance;
    bound->add(*maps.depth);
    bound->add(*maps.frames);
  }
  return {most_lights_of_a_dispatch, {}};
}

// Bits in as many buffers as the device's storage-buffer range asks for.
ShadePass::Sight ShadePass::upload_bits(uint32_t words) const {
  const uint64_t light_bytes = words * sizeof(uint32_t);
  Sight sight{static_cast<uint32_t>(std::clamp<uint64_t>(stage_.device.info().max_storage_range / light_bytes,
                                                         1, most_lights_of_a_dispatch)),
              {}};
  for (const LightRange& range : light_ranges(lights_.count(), sight.most_lights)) {
    const size_t index = range.first / sight.most_lights, bytes = range.count * light_bytes;
    const Buffer& bits =
        stage_.memory.visibility[index].get(stage_.device, fmt::format("visibility {}", index), bytes);
    bits.upload(&bits_[size_t(range.first) * words], bytes);
    sight.bits.push_back(&bits);
  }
  return sight;
}

}  // namespace vsglbench
