// How VSGLs are shaded: each choice is a preprocessor value of the kernels that evaluate them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gpu/shader_compiler.h"

namespace vsglbench {

// One choice that a config makes, by its key.
struct ShadingAxis {
  std::string key, define;
  std::vector<std::string> choices;  // in the order of the define's values, the default first
  std::string description;
};
const std::vector<ShadingAxis>& shading_axes();

// Choice by key; a key that is absent has its default.
using Shading = std::map<std::string, std::string>;
std::string chosen(const Shading& shading, const std::string& key);

// Throws Error(config) naming the nearest choice.
void check_shading_choice(const std::string& key, const std::string& choice);

// The defines of the choices that are not their default: kernels of the default carry no define.
ShaderDefines shading_defines(const Shading& shading);

}  // namespace vsglbench
