// Which effects a scene calls for, derived from geometry, materials, light and camera before anything is
// allocated or compiled [measurement, Effects]. What none asks for is left out of a frame
// (frame/permutation.h), so that an effect is skipped only where it provably can't change the image: every
// rule errs towards "needed".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace vsglbench {

enum class Effect : uint8_t {
  diffuse_receivers,    // the camera sees a surface with a diffuse lobe
  diffuse_emitters,     // the light lights one
  glossy_receivers,     // the camera sees a surface with a specular lobe
  glossy_emitters,      // the light lights one: caustics
  phong_lobes,          // a lit or seen surface has Phong's normal distribution; without it, GGX of its width
  occlusion,            // something may stand between a lit and a seen surface
  base_color_textures,  // on a lit or seen surface, as are the following
  metallic_roughness_textures,
  normal_maps,
  smooth_normals,  // vertex normals that are not the face's
  alpha_masks,     // with a texel that is a hole
  moving_objects,
  moving_light,
  moving_camera,
};
inline constexpr unsigned kEffects = 14;

// As reports and options name them: the enumerators. In their order.
const std::vector<std::string>& effect_names();
const std::string& name(Effect effect);
Effect effect_named(const std::string& name);  // throws Error(config) naming the nearest one
// What it is, in a line, and what a frame does without it.
const char* description(Effect effect);

class EffectSet {
 public:
  static EffectSet all() { return EffectSet((1u << kEffects) - 1); }
  static EffectSet none() { return EffectSet(0); }
  bool has(Effect effect) const { return bits_ >> static_cast<unsigned>(effect) & 1u; }
  EffectSet& add(Effect effect) { return bits_ |= 1u << static_cast<unsigned>(effect), *this; }
  EffectSet operator|(const EffectSet& other) const { return EffectSet(bits_ | other.bits_); }
  EffectSet operator-(const EffectSet& other) const { return EffectSet(bits_ & ~other.bits_); }
  auto operator<=>(const EffectSet&) const = default;

 private:
  explicit EffectSet(uint32_t bits) : bits_(bits) {}
  uint32_t bits_;
};

// "" none, "all", or names parted by commas, in any order. Throws Error(config) naming the nearest one.
EffectSet parse_effects(const std::string& text);
// The same text, in the order of the enumeration.
std::string to_text(const EffectSet& effects);

struct EffectDecision {
  Effect effect;
  bool needed = true;
  std::string reason;  // a clause: "material 'floor' of the seen triangle 3 has F0 up to 0.04"
};

// One decision an effect, in their order. `aspect`: width over height of the image.
std::vector<EffectDecision> derive_effects(const Scene& scene, float aspect);
EffectSet needed(const std::vector<EffectDecision>& decisions);

}  // namespace vsglbench
