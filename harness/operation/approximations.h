// What each approximation of shading costs in accuracy: the device's value against the rendering integral
// with exact BRDFs (shaders/rendering_integral.h), over view angles. The committed table of these errors,
// approximations.csv, is what tests hold the kernels to.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "operation/sg_receiver.h"
#include "operation/shading_probe.h"

namespace vsglbench {

inline constexpr size_t kViewAngles = std::size(sg_receiver::kViews);

// (value - integral)/integral at each angle of sg_receiver::kViews.
struct ErrorRow {
  std::string name;
  std::array<double, kViewAngles> error{};
};

// The oracles, each a part of what shading approximates:
//  receiver   the receiver's specular lobe as an ASG, under an SG [MFIS16 App. C.2]
//  filtered   the same with the NDF widened by the SG in place of the ASG, `receiver` sg
//  isotropic  the same rows with one SG about the mirror direction, `receiver` isotropic
//  emitter    a set of texels' exact BRDFs as one SG [MFIS16 App. B.1], seen from far away; angle: of the
//  primary light at
//             the texels
//  gaussian   vsgl16: a light's Gaussian of positions and its lobe as one SG [MFIS16 Eq. 11, 12]
//  disk       vsgl14: a light's disk and its lobe in triple products [VSGL14 Eq. 3] against its Eq. 2
//  cancelled  ρ(ω_i)|Ω|/(πr²) [VSGL14 §3.3] against the same integral with exact BRDFs at both ends
//  filtered_brdfs  `shading` filtered, both NDFs filtered by the disk, against the integral over the disk
//             across the texel's normal, with exact BRDFs at both ends
// The last four have light and viewer at the same angle to the normal, on either side.
const std::vector<std::string>& oracle_names();
std::vector<ErrorRow> approximation_errors(Device& device, const std::string& oracle);

// The mean of `runs` estimates of a virtual spherical light against the integral that they estimate [VSGL14
// Eq. 2], relative to it.
struct SampledError {
  std::string name;
  double error = 0, standard_error = 0;
};
std::vector<SampledError> vsl_errors(Device& device, uint32_t runs);

// Where bias reduction decides otherwise than η_p < α 4π/|Ω| [VSGL14 §3.3], 1 % on either side of the bound,
// with η_p the curvature of the Phong lobe by finite differences plus the emitter's sharpness; and where it
// keeps a diffuse pair. A line each; empty: nowhere.
std::vector<std::string> wrong_cancellations(Device& device);

}  // namespace vsglbench
