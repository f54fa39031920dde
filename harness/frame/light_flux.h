// The power of lights and of RSM texels in one unit, so that their sums can be compared: luminance of the
// power that is reflected, in both lobes, W. In double precision.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "shaders/types.h"

namespace vsglbench {

// Rd + Rs of a surface lit from a direction whose cosine with its shading normal is `cosine`: what leaves it
// over what arrives, per channel, as its lobes carry it [MFIS16 Eq. 7] (shaders/field.glsl). `ndf` as in
// gpu::Vpl.
glm::dvec3 lobe_reflectance(const glm::vec3& diffuse, const glm::vec3& f0, double ndf, double cosine);

// The flux of both lobes of a VSGL, ∫ c G = c A(λ); of a VPL or VSL, whose flux is incident, Φ (Rd + Rs).
glm::dvec3 lobe_power(const gpu::Vsgl& light);  // by channel
double reflected_power(const gpu::Vsgl& light);
double reflected_power(const gpu::Vpl& light);
// Luminance of Φ, W.
double incident_power(const gpu::Vpl& light);

// Σ over the texels with a surface. `maps`: the half's five targets (shaders/field_maps.glsl), row by row.
double reflected_power(const gpu::Emitter& emitter, const std::array<std::vector<glm::vec4>, 5>& maps);

}  // namespace vsglbench
