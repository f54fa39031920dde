// Pixels against double precision: the same single-precision lights and surfaces, shaded by
// shaders/shading_exact.h.
#pragma once

#include <optional>
#include <span>

#include "conformance/lights.h"
#include "method/oracle.h"
#include "shaders/shading_exact.h"
#include "stability/cell.h"

namespace vsglbench {

// `pixels`: radiance at each texel of `receivers`, row-major, whose emitter is the eye. The error of a
// pixel's channel is
//   |pixel - exact| / (|exact| + 0.01 m + 1000 s)
// with m the mean of |exact| over all pixels or, for diffuse models other than the cosine, of the diffuse
// radiance of surfaces turned to each light, where that is more: those models' errors are absolute
// (shaders/sg_diffuse.glsl), and no smaller for a light behind the surface. s is the change of `exact` when
// each direction that goes in (to the light, view, normals, axes) and each sharpness is off by one rounding,
// 2^-23: a sharpness of 2^41 makes of a rounded direction an exponent that is off by 0.1, in any
// implementation, and such an error counts as 1e-3 a rounding. s is looked at only where the error is above
// kOkError without it. Radiance below single precision's normal numbers counts as 0. `black`: all pixels must
// be 0. Lights whose shading has no double form (VSLs, which are sampled; no `shading`) are held to that and
// to be finite and not negative. `filtered`: what the pixels are by where the shading is filtered, else none.
void check_shading(const oracle::Half& receivers, std::span<const glm::vec3> pixels,
                   const LightRecords& lights, std::vector<gpu::FilteredLight> filtered,
                   const std::optional<exact::VsglShading>& shading, bool black, Judgement* verdict);

}  // namespace vsglbench
