// Colours as FLIP sees them [Andersson et al. 2020, §4.1]: linear Rec.709 in 0 … 1, the opponent space in
// which contrast sensitivity acts, and CIELAB with Hunt's effect, in which differences are measured.
#pragma once

#include <glm/glm.hpp>

namespace vsglbench {

// Narkowicz' fit of the ACES curve with its exposure of 0.6 taken out, clamped to 0 … 1 [Andersson et al.
// 2021, §3.2]. x: 0 or above, Inf gives 1.
float aces(float x);
// Where aces() reaches `t`, 0 < t < 1.
double aces_inverse(double t);

// (Y, X−Y, Y−Z) over the white of D65: YCxCz without its factors 116, 500 and 200 and its offset, which a
// filter whose weights add up to 1 leaves alone.
glm::vec3 to_opponent(const glm::vec3& linear);
glm::vec3 from_opponent(const glm::vec3& opponent);

// L*, and a* and b* times 0.01 L* (Hunt: bright colours look more colourful).
glm::vec3 to_hunt_lab(const glm::vec3& linear);

// |ΔL| + √(Δa² + Δb²), to the power of 0.7, mapped to 0 … 1: linearly to 0.95 at 0.4 of the largest distance
// in the gamut, that of green and blue, and on to 1 at the largest.
float color_error(const glm::vec3& hunt_lab1, const glm::vec3& hunt_lab2);

}  // namespace vsglbench
