// Textures made by code, from integer hashes: equal on every run. All repeat seamlessly.
#pragma once

#include "scene/scene.h"

namespace vsglbench {

// A colour and the normal map of the same relief; size x size texels.
struct TexturePair {
  Texture color, normal;
};

TexturePair ashlar_textures(uint32_t size);  // 4 x 8 cut stones with sunken joints
TexturePair tile_textures(uint32_t size);    // 4 x 4 chequered marble tiles, each laid a little off level
TexturePair stone_textures(uint32_t size);   // plain weathered stone
TexturePair weave_textures(uint32_t size);   // undyed cloth, to be coloured by the material

}  // namespace vsglbench
