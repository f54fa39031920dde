// The rendering integral L = ∫ f(v,ω) max(n·ω,0) L_in(ω) dω with exact BRDFs, by cubature in double
// precision: what every approximation of shading is held to. Nothing here comes from the formulas that
// shading uses; the BRDF is the surface's own (brdf_cosine), L_in each light's definition.
//
// What the anisotropic SG at the receiver [MFIS16 App. C.2] must be, from the definition alone. The half
// vector of v and ω is h = (v+ω)/|v+ω|. About the mirror direction, v·n = ω·n = c:
//   * in the plane of incidence, ω turned by δ turns h by δ/2, since h bisects the angle;
//   * across it, ω + δ y has h ∝ 2c n + δ y, turned by δ/(2c).
// A distribution of sharpness λh falls as exp(-λh γ²/2) with the angle γ of h from n, so the lobe falls as
// exp(-λh δ²/8) in the plane and as exp(-λh δ²/(8c²)) across it. For λh = 1000: 125 and 500 at 60°, 125 and
// 1866 at 75°. reflected_bandwidths() measures these by finite differences of D(h).
//
// Sources: [MFIS16] Eq. 8-10, [VSGL14] Eq. 2.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "shaders/shading_exact.h"

namespace vsglbench::exact {

// Radiance that arrives at a surface from each direction, W/(m² sr), and where it is large.
struct Incoming {
  std::function<glm::dvec3(const glm::dvec3&)> radiance;
  std::vector<Peak> peaks;
  Cone cone{{0, 0, 1}, 3.14159265358979};  // outside, the radiance is 0 or as good as that
};

// G(ω;axis,sharpness), grey.
Incoming incoming_sg(const glm::dvec3& axis, double sharpness);

// Radiance from a VSGL whose lights stand about μ as an isotropic Gaussian of variance σ² along each axis,
// γ(|y-μ|,σ²)/(2πσ²)³ᐟ² [MFIS16 Eq. 8's, in space], each of intensity c G(-ω) of both lobes. The integral
// along a ray is closed:
//   L_in(ω) = I(-ω) e^{-d² sin²θ/(2σ²)} ½ erfc(-d cosθ/(σ√2)) / (2πσ²),  θ from the direction to μ at
//   distance d.
Incoming incoming_gaussian(const gpu::Vsgl& light, const glm::dvec3& position);

// Radiance from a virtual spherical light [VSGL14 Eq. 2]: intensity(ω) V(ω)/(πr²), V = 1 within the cone of
// tan θ = r/d, r² = 2σ². Intensities: of the VSGL's lobes, with its diffuse power over π and the cosine about
// the diffuse axis, and its specular lobe as it is; or of a texel's exact BRDF, Φ f cos.
Incoming incoming_disk(const gpu::Vsgl& light, const glm::dvec3& position);
Incoming incoming_disk(const gpu::Vsgl& light, const gpu::Vpl& texel, const glm::dvec3& position);

// The integral, to `relative_error`.
Integral reflected_radiance(const Surface& surface, const Incoming& incoming, double relative_error);

// Radiance reflected of a disk of r² = 2σ² across the texel's normal, each point of which reflects Φ/(πr²) by
// the texel's exact BRDF: ∫Φ f_v cosθ_v f_x cosθ_x/d² dA/(πr²), to `relative_error`. `variance`: σ², m².
Integral radiance_of_disk(const Surface& surface, const gpu::Vpl& texel, double variance,
                          double relative_error);

// Bandwidths η of exp(-η δ²) that D(h) has where ω leaves the mirror direction by δ: in the plane of
// incidence, and across it; by finite differences.
std::pair<double, double> reflected_bandwidths(const Surface& surface);

}  // namespace vsglbench::exact
