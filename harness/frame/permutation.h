// Shader variants: the one place that says which kernels an effect changes, and how.
//
// What no effect asks for (scene/effects.h) is left out of every kernel at compile time, by these values; a
// kernel of all effects carries none of them, so that it is the same as one that knows nothing of effects.
//   SURFACE_LOBES, LIGHT_LOBES  lobes of the surfaces it loads, and of the lights it makes or evaluates
//                               (shaders/types.h): of each half those that *_receivers (G-buffer) and
//                               *_emitters (RSM) leave
//   FACE_NORMALS                1 without smooth_normals and normal_maps
//   PHONG_LOBES                 0 without phong_lobes
// and, of the rasteriser alone,
//   BASE_COLOR_TEXTURES, METALLIC_ROUGHNESS_TEXTURES, NORMAL_MAPS, SMOOTH_NORMALS, ALPHA_MASKS
//                               0 without the effect of that name
//   NO_LOBE                     1 where neither lobe of the half is left: its surfaces reflect nothing, with
//                               the channels and kernels of a diffuse lobe whose Rd is 0
#pragma once

#include "gpu/pass_id.h"
#include "gpu/shader_compiler.h"
#include "scene/effects.h"

namespace vsglbench {

// Lobes of a half's surfaces, and of the lights made of them, as in shaders/types.h; the diffuse one where
// none is left.
unsigned lobes_of(const EffectSet& effects, Half half);
// Whether the shading normals are the faces'.
bool has_face_normals(const EffectSet& effects);

// Defines of a kernel that loads texels of `surfaces` and makes or evaluates lights of `lights`.
ShaderDefines permutation(const EffectSet& effects, Half surfaces, Half lights);
// Defines of the rasteriser of one half.
ShaderDefines raster_permutation(const EffectSet& effects, Half half);

// All of both; a key stands in one of them only.
ShaderDefines merged(ShaderDefines a, const ShaderDefines& b);

}  // namespace vsglbench
