#include "frame/permutation.h"

#include <utility>

#include "shaders/types.h"

namespace vsglbench {
namespace {

bool has_diffuse(const EffectSet& effects, Half half) {
  return effects.has(half == Half::gbuffer ? Effect::diffuse_receivers : Effect::diffuse_emitters);
}
bool has_specular(const EffectSet& effects, Half half) {
  return effects.has(half == Half::gbuffer ? Effect::glossy_receivers : Effect::glossy_emitters);
}
bool has_no_lobe(const EffectSet& effects, Half half) {
  return !has_diffuse(effects, half) && !has_specular(effects, half);
}

}  // namespace

unsigned lobes_of(const EffectSet& effects, Half half) {
  if (has_no_lobe(effects, half)) return DIFFUSE_LOBE;
  return (has_diffuse(effects, half) ? DIFFUSE_LOBE : 0) | (has_specular(effects, half) ? SPECULAR_LOBE : 0);
}

bool has_face_normals(const EffectSet& effects) {
  return !effects.has(Effect::smooth_normals) && !effects.has(Effect::normal_maps);
}

ShaderDefines permutation(const EffectSet& effects, Half surfaces, Half lights) {
  constexpr unsigned both = DIFFUSE_LOBE | SPECULAR_LOBE;
  ShaderDefines defines;
  if (const unsigned lobes = lobes_of(effects, surfaces); lobes != both)
    defines["SURFACE_LOBES"] = std::to_string(lobes);
  if (const unsigned lobes = lobes_of(effects, lights); lobes != both)
    defines["LIGHT_LOBES"] = std::to_string(lobes);
  if (has_face_normals(effects)) defines["FACE_NORMALS"] = "1";
  if (!effects.has(Effect::phong_lobes)) defines["PHONG_LOBES"] = "0";
  return defines;
}

ShaderDefines raster_permutation(const EffectSet& effects, Half half) {
  ShaderDefines defines = permutation(effects, half, half);
  defines.erase("LIGHT_LOBES");
  if (has_no_lobe(effects, half)) defines["NO_LOBE"] = "1";
  for (const auto& [effect, define] :
       {std::pair(Effect::base_color_textures, "BASE_COLOR_TEXTURES"),
        std::pair(Effect::metallic_roughness_textures, "METALLIC_ROUGHNESS_TEXTURES"),
        std::pair(Effect::normal_maps, "NORMAL_MAPS"), std::pair(Effect::smooth_normals, "SMOOTH_NORMALS"),
        std::pair(Effect::alpha_masks, "ALPHA_MASKS")}) {
    if (!effects.has(effect)) defines[define] = "0";
  }
  return defines;
}

ShaderDefines merged(ShaderDefines a, const ShaderDefines& b) {
  a.insert(b.begin(), b.end());
  return a;
}

}  // namespace vsglbench
