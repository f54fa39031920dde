#include "scene/effects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/error.h"
#include "base/nearest.h"
#include "scene/animation.h"
#include "scene/effect_search.h"

namespace vsglbench {
namespace {

struct Row {
  const char* name;
  const char* description;
};
// In the order of the enumeration.
constexpr Row kRows[kEffects] = {
    {"diffuse_receivers", "diffuse reflection towards the camera"},
    {"diffuse_emitters", "diffuse reflection of the primary light"},
    {"glossy_receivers", "specular reflection towards the camera"},
    {"glossy_emitters", "specular reflection of the primary light: caustics"},
    {"phong_lobes", "normal distributions of Phong; without, GGX as wide"},
    {"occlusion", "shadows between lit and seen surfaces"},
    {"base_color_textures", "textured reflectance"},
    {"metallic_roughness_textures", "textured metalness and roughness"},
    {"normal_maps", "normals from textures"},
    {"smooth_normals", "vertex normals that are not the face's"},
    {"alpha_masks", "holes from textures"},
    {"moving_objects", "objects that move"},
    {"moving_light", "a primary light that moves"},
    {"moving_camera", "a camera that moves"},
};

// What a material may do anywhere on it, over all its texels.
struct MaterialFacts {
  bool diffuse = false, specular = false;  // Rd or F0 above 0
  bool holes = false;
};

// Rd = c (1-m) (1-0.04 s) and F0 = s mix(0.04, c, m), as scene.h defines them.
MaterialFacts facts_of(const Scene& scene, const Material& m) {
  const TexelRange color = texel_range(scene, m.base_color_texture);
  const TexelRange surface = texel_range(scene, m.metallic_roughness_texture);
  const glm::vec3 brightest = glm::vec3(m.base_color) * glm::vec3(color.high);
  const bool colored = std::max({brightest.x, brightest.y, brightest.z}) > 0;
  const bool all_metal = m.metallic >= 1 && surface.low.z >= 1;
  const bool some_metal = m.metallic > 0 && surface.high.z > 0;
  return {.diffuse = colored && !all_metal,
          .specular = m.specular > 0 && (!all_metal || (colored && some_metal)),
          .holes = m.alpha_cutoff >= 0 && m.base_color.w * color.low.w < m.alpha_cutoff};
}

// When a material asks for an effect, wherever it is seen or lit.
struct MaterialRule {
  Effect effect;
  bool seen, lit;  // which surfaces count
  bool (*asks)(const Material&, const MaterialFacts&);
  const char* because;    // "material 'x' BECAUSE, on the lit triangle 3"
  const char* otherwise;  // why it is skipped
};

const std::vector<MaterialRule>& material_rules() {
  const auto diffuse = [](const Material&, const MaterialFacts& facts) { return facts.diffuse; };
  const auto specular = [](const Material&, const MaterialFacts& facts) { return facts.specular; };
  static const std::vector<MaterialRule> rules = {
      {Effect::diffuse_receivers, true, false, diffuse, "has a diffuse lobe", "Rd is 0 on all seen surfaces"},
      {Effect::diffuse_emitters, false, true, diffuse, "has a diffuse lobe", "Rd is 0 on all lit surfaces"},
      {Effect::glossy_receivers, true, false, specular, "has a specular lobe",
       "F0 is 0 on all seen surfaces"},
      {Effect::glossy_emitters, false, true, specular, "has a specular lobe", "F0 is 0 on all lit surfaces"},
      {Effect::phong_lobes, true, true,
       [](const Material& m, const MaterialFacts&) { return m.phong_exponent > 0; }, "has a Phong exponent",
       "no lit or seen surface has a Phong exponent"},
      {Effect::base_color_textures, true, true,
       [](const Material& m, const MaterialFacts&) { return m.base_color_texture >= 0; },
       "has a base-colour texture", "no lit or seen surface has one"},
      {Effect::metallic_roughness_textures, true, true,
       [](const Material& m, const MaterialFacts&) { return m.metallic_roughness_texture >= 0; },
       "has a metallic-roughness texture", "no lit or seen surface has one"},
      {Effect::normal_maps, true, true,
       [](const Material& m, const MaterialFacts&) { return m.normal_texture >= 0; }, "has a normal map",
       "no lit or seen surface has one"},
      {Effect::alpha_masks, true, true,
       [](const Material&, const MaterialFacts& facts) { return facts.holes; },
       "has a texel whose alpha is below its cutoff", "no lit or seen surface has a hole"},
  };
  return rules;
}

EffectDecision decide(const Scene& scene, const EffectSearch& search, const std::vector<MaterialFacts>& facts,
                      const MaterialRule& rule) {
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const MaterialSight& sight = search.materials()[i];
    const bool seen = rule.seen && sight.seen, lit = rule.lit && sight.lit;
    if ((!seen && !lit) || !rule.asks(scene.materials[i], facts[i])) continue;
    return {rule.effect, true,
            fmt::format("material '{}' {}, on the {} triangle {}", scene.materials[i].name, rule.because,
                        lit ? "lit" : "seen", lit ? *sight.lit : *sight.seen)};
  }
  return {rule.effect, false, rule.otherwise};
}

}  // namespace

const std::vector<std::string>& effect_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const Row& row : kRows) out.emplace_back(row.name);
    return out;
  }();
  return names;
}

const std::string& name(Effect effect) { return effect_names().at(static_cast<size_t>(effect)); }
const char* description(Effect effect) { return kRows[static_cast<size_t>(effect)].description; }

Effect effect_named(const std::string& name) {
  const auto& names = effect_names();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    const std::string near = suggestion(name, names);
    throw fail(ErrorKind::config, "no effect '{}'{}", name,
               near.starts_with("; did you mean") ? near : "; see vsglbench list effects");
  }
  return static_cast<Effect>(found - names.begin());
}

EffectSet parse_effects(const std::string& text) {
  if (text == "all") return EffectSet::all();
  EffectSet set = EffectSet::none();
  for (size_t at = 0; !text.empty() && at <= text.size();) {
    const size_t comma = std::min(text.find(',', at), text.size());
    const std::string one = text.substr(at, comma - at);
    if (one == "all") throw fail(ErrorKind::config, "'all' stands for every effect; give it alone");
    const Effect effect = effect_named(one);
    if (effect >= Effect::moving_objects)  // no frame can leave it out or add it
      throw fail(ErrorKind::config, "{} is the scene's: it can be neither forced nor skipped", one);
    set.add(effect);
    at = comma + 1;
  }
  return set;
}

std::string to_text(const EffectSet& effects) {
  if (effects == EffectSet::all()) return "all";
  std::vector<std::string> names;
  for (unsigned i = 0; i < kEffects; ++i)
    if (effects.has(static_cast<Effect>(i))) names.push_back(effect_names()[i]);
  return fmt::format("{}", fmt::join(names, ","));
}

namespace {

// What moves in any frame, by the poses themselves.
std::vector<EffectDecision> decide_motion(const Scene& scene) {
  const Moved& moves = scene.animation.moves;
  const std::string nothing =
      frame_count(scene) == 1 ? "the scene has one frame"
                              : fmt::format("nothing of this kind moves in {} frames", frame_count(scene));
  const auto decision = [&](Effect effect, bool moves_at_all, const std::string& what) {
    return EffectDecision{effect, moves_at_all, moves_at_all ? what : nothing};
  };
  const std::string first = moves.objects.empty() ? "" : scene.animation.objects[moves.objects.front()].name;
  return {decision(Effect::moving_objects, !moves.objects.empty(), fmt::format("object '{}' moves", first)),
          decision(Effect::moving_light, moves.light, "the light moves"),
          decision(Effect::moving_camera, moves.camera, "the camera moves")};
}

// Every frame of a scene in motion: what is needed in one of them is needed.
EffectSearch search_all_poses(const Scene& scene, float aspect) {
  EffectSearch search(scene);
  if (frame_count(scene) == 1) {
    search.add_pose(scene, aspect);
    return search;
  }
  Scene posed = scene;
  for (uint32_t frame = 0; frame < frame_count(scene); ++frame) {
    set_frame(&posed, frame);
    search.add_pose(posed, aspect);
  }
  return search;
}

}  // namespace

std::vector<EffectDecision> derive_effects(const Scene& scene, float aspect) {
  const EffectSearch search = search_all_poses(scene, aspect);
  std::vector<MaterialFacts> facts;
  for (const Material& material : scene.materials) facts.push_back(facts_of(scene, material));
  std::vector<EffectDecision> out;
  for (const MaterialRule& rule : material_rules()) out.push_back(decide(scene, search, facts, rule));
  const auto smooth = search.smooth();
  out.push_back({Effect::smooth_normals, smooth.has_value(),
                 smooth ? fmt::format("vertex normals of the triangle {} are not its face's", *smooth)
                        : "every lit or seen vertex normal is its face's"});
  out.push_back({Effect::occlusion, search.occluder().possible, search.occluder().reason});
  for (EffectDecision& decision : decide_motion(scene)) out.push_back(std::move(decision));
  std::ranges::sort(out, {}, &EffectDecision::effect);
  return out;
}

EffectSet needed(const std::vector<EffectDecision>& decisions) {
  EffectSet set = EffectSet::none();
  for (const EffectDecision& d : decisions)
    if (d.needed) set.add(d.effect);
  return set;
}

}  // namespace vsglbench
