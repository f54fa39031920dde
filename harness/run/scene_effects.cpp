#include "run/scene_effects.h"

namespace vsglbench {
namespace {

// Passes that an effect concerns: those that read or write what it asks for.
std::vector<std::string> passes_of(Effect effect) {
  switch (effect) {
    case Effect::diffuse_receivers:
    case Effect::glossy_receivers:
      return {"gbuffer", "importance.gbuffer", "generate.gbuffer", "importance.rsm", "shade"};
    case Effect::diffuse_emitters:
    case Effect::glossy_emitters:
      return {"rsm", "importance.rsm", "generate.rsm", "shade"};
    case Effect::phong_lobes:
      return {"gbuffer", "rsm", "importance", "generate", "shade"};
    case Effect::occlusion:
      return {"visibility", "shade"};
    case Effect::base_color_textures:
    case Effect::metallic_roughness_textures:
    case Effect::alpha_masks:
      return {"gbuffer", "rsm"};
    case Effect::normal_maps:
    case Effect::smooth_normals:
      return {"gbuffer", "rsm", "importance", "generate", "shade"};
    case Effect::moving_objects:
      return {"gbuffer", "rsm"};
    case Effect::moving_light:
      return {"rsm"};
    case Effect::moving_camera:
      return {"gbuffer"};
  }
  return {};
}

}  // namespace

const std::vector<EffectDecision>& SceneEffects::decisions(uint32_t width, uint32_t height) {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  const auto [at, is_new] = decisions_.try_emplace(aspect);
  if (is_new) at->second = derive_effects(scene_, aspect);
  return at->second;
}

EffectSet SceneEffects::of(const FrameParameters& p) {
  EffectSet effects = needed(decisions(p.width, p.height)) | p.force_effects;
  if (has_shadow_maps(p.visibility)) effects.add(Effect::occlusion);
  return effects - p.skip_effects;
}

std::vector<EffectReport> ledger(const std::vector<EffectDecision>& decisions) {
  std::vector<EffectReport> out;
  for (const EffectDecision& d : decisions) {
    EffectReport report;
    report.name = name(d.effect);
    report.needed = d.needed;
    report.reason = d.reason;
    report.passes = passes_of(d.effect);
    out.push_back(report);
  }
  return out;
}

}  // namespace vsglbench
