#include "frame/shading.h"

#include <algorithm>

#include "base/error.h"
#include "base/nearest.h"

namespace vsglbench {

const std::vector<ShadingAxis>& shading_axes() {
  static const std::vector<ShadingAxis> axes = {
      {"shading",
       "SHADING_MODEL",
       {"vsgl16", "vsgl14", "filtered"},
       "products of a light's SGs [MFIS16 App. C]; triple products with the disk's solid angle [VSGL14 "
       "§3.1]; or exact BRDFs, filtered by the disk"},
      {"lobe_filter",
       "LOBE_FILTER",
       {"on", "off"},
       "whether a light's specular lobe is its texels' filtered one, or that of one of them [VSGL14 Fig. 3]"},
      {"diffuse",
       "DIFFUSE_MODEL",
       {"cosine", "pettineo-hill", "meder-bruederlin", "tokuyoshi2022", "tokuyoshi2024"},
       "the integral of an SG and the clamped cosine [MFIS16 App. C.2; SGL22]"},
      {"lobes",
       "LOBE_CONVERSION",
       {"toksvig", "banerjee"},
       "from a mean direction's length to a lobe's sharpness [MFIS16 App. B.1; Banerjee 2005]"},
      {"variance",
       "VARIANCE",
       {"3d", "disk"},
       "a light's variance: the paper's of three dimensions [MFIS16 App. B.2], or half of it, a disk's"},
      {"receiver",
       "RECEIVER_LOBE",
       {"asg", "sg", "isotropic"},
       "the receiver's specular lobe: an anisotropic SG [VSGL15s App. B], its NDF widened by the light's SG, "
       "or "
       "one SG about the mirror direction [VSGL15s App. A]"},
      {"lambert_sharpness",
       "LAMBERT_LOBE",
       {"2", "2.2925"},
       "sharpness of a texel's diffuse lobe: [VSGL15s App. A.1]'s, or that of the author's later code"},
      {"light_clearance",
       "LIGHT_CLEARANCE",
       {"0", "sigma"},
       "how far from a light's mean nothing counts as an occluder: the papers' test at the mean, or its σ"},
  };
  return axes;
}

std::string chosen(const Shading& shading, const std::string& key) {
  if (const auto it = shading.find(key); it != shading.end()) return it->second;
  return std::ranges::find(shading_axes(), key, &ShadingAxis::key)->choices.front();
}

void check_shading_choice(const std::string& key, const std::string& choice) {
  for (const ShadingAxis& axis : shading_axes()) {
    if (axis.key != key || std::ranges::count(axis.choices, choice) > 0) continue;
    throw fail(ErrorKind::config, "no {} '{}'{}", key, choice, suggestion(choice, axis.choices));
  }
}

ShaderDefines shading_defines(const Shading& shading) {
  ShaderDefines defines;
  for (const ShadingAxis& axis : shading_axes()) {
    const auto chosen = shading.find(axis.key);
    if (chosen == shading.end() || chosen->second == axis.choices.front()) continue;
    const auto value = std::ranges::find(axis.choices, chosen->second) - axis.choices.begin();
    defines[axis.define] = std::to_string(value);
  }
  return defines;
}

}  // namespace vsglbench
