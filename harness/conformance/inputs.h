// Inside the conformance kit: the halves that a method is tried on.
#pragma once

#include <string>
#include <vector>

#include "method/made_half.h"

namespace vsglbench {

struct ConformanceInput {
  enum class Pdf { made, zero, uniform, one_texel, one_huge, checkerboard };
  enum class Surface { made, none, one_texel, black, coincident, mirror, far };
  enum class Light { on, off };
  Half half = Half::rsm;
  uint32_t width = 64, height = 48;
  uint32_t count = 64;  // N
  Pdf pdf = Pdf::made;
  Surface surface = Surface::made;
  Light light = Light::on;

  // "half rsm 7×5, N = 35, PDF zero but texel (3,2)".
  std::string name() const;
  oracle::Half make() const;
  // No light of this kind may have power.
  bool powerless(LightKind kind) const;
  uint64_t texels() const { return uint64_t(width) * height; }
};

// Sizes, counts, PDFs and surfaces that a frame can meet, on one half.
std::vector<ConformanceInput> all_inputs(Half half);
// A few of them that take every path, for checks that look at something else than the lights.
std::vector<ConformanceInput> few_inputs(Half half);

}  // namespace vsglbench
