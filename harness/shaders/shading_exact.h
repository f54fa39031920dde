// Shading in double precision on the host: one light at one surface, without visibility. Written from the
// papers, not from the GLSL of this folder, of which it is the oracle: of the pixels' kernel, of random
// testing and of the stability suite. It keeps the kernel's stated conventions (floors, black lights), so
// that a difference is one of arithmetic. Sources: [MFIS16] App. C, [VSGL15s] App. A–B, [VSGL14];
// Walter et al. 2007, Heitz 2014 (masking), Genz and Malik 1980 (quadrature).
#pragma once

#include "shaders/cubature.h"
#include "shaders/sg_exact.h"
#include "shaders/types.h"

namespace vsglbench::exact {

// A surface seen from `view`. All directions are unit and point away from it.
struct Surface {
  glm::dvec3 position;          // metres
  glm::dvec3 normal;            // shading
  glm::dvec3 geometric_normal;  // of the face, on the viewer's side
  glm::dvec3 view;
  glm::dvec3 diffuse;  // Rd
  glm::dvec3 f0;
  double ndf = 1;  // > 0: GGX alpha; < 0: minus the Phong exponent
};

// D(h) of the surface's distribution, 1/sr; h is unit.
double ndf_value(double ndf, const glm::dvec3& normal, const glm::dvec3& h);

// f(l,v) n·l of Lambert and one microfacet lobe, 1/sr; zero unless both directions are above the shading
// normal's horizon and l above the face's.
glm::dvec3 brdf_cosine(const Surface& surface, const glm::dvec3& l);

// The mirror direction, where the specular lobe is large, and the lesser width of the lobe there: that of the
// half vector's distribution times 2 l·h.
Peak reflected_lobe(const Surface& surface);

// The surface that a point light stands on, seen from the primary light.
Surface surface_of(const gpu::Vpl& light);

// How a VSGL shades, in the order of GLSL's SHADING_MODEL: products of SGs [MFIS16 App. C], or triple
// products with the disk that the light is seen as [VSGL14 §3.1].
enum class VsglModel { vsgl16, vsgl14 };

struct VsglShading {
  DiffuseModel diffuse = DiffuseModel::cosine;  // of vsgl16
  bool disk = false;                            // σ² counts half
  bool quadrature = false;                      // L(v,κ) itself, instead of `diffuse`
  VsglModel model = VsglModel::vsgl16;
};

// Reflected radiance, W/(m² sr), of a light's both lobes; 0 for a light of no power.
// Conventions: n·v is 0.01 at least; the squared distance is 1e-20 m² at least; σ² is the squared distance ×
// 2^-41 at least, so that λ_σ <= 2^41; every diffuse model but pettineo-hill is held to [0,1], and
// pettineo-hill's sharpness to 1e-6 at least. Of vsgl14: the light's diffuse lobe is its power over π with
// sharpness 0 and n_i its axis; its specular lobe holds its cosine [MFIS16 Eq. 7], so <-ω_i,n_i> is left out
// there; of the receiver's coefficient, masking is taken at ω_i with the cosine, Fresnel at the axis of the
// product of the light's lobe and the disk.
glm::dvec3 shade_vsgl(const Surface& surface, const gpu::Vsgl& light, const VsglShading& shading);

// Consistent bias reduction [VSGL14 §3.3]. A light is cancelled where η_p < α 4π/|Ω|, which is where α is
// above cancelling_alpha() = η_p |Ω|/4π. η_p, the sharpness of the sharpest product of a lobe of the receiver
// (an ASG of bandwidth η has 2η) and one of the light's, is the sum of the two; a diffuse lobe of either has
// 0. The same floors as above; the disk has r² = 2σ² of the variance in three dimensions, whatever `disk`
// says.
double cancelling_alpha(const Surface& surface, const gpu::Vsgl& light);
// What it is shaded with then: ρ(ω_i) |Ω|/(πr²) with exact BRDFs, `texel` at the light's end.
glm::dvec3 shade_cancelled(const Surface& surface, const gpu::Vsgl& light, const gpu::Vpl& texel);

// Φ f(x2) f(x1) cos cos / d² [VSGL14 Eq. 1]; 0 for a light of no power, or at the surface itself.
glm::dvec3 shade_vpl(const Surface& surface, const gpu::Vpl& light);

// Φ f_v f_x T/r²: T is the form factor of the disk of r² = 2σ² across the light's normal, cut by the
// surface's horizon as disk.glsl does it; 0 where the light's mean is below that. Each NDF is filtered by the
// disk: over half vectors that has the sharpness λ' = 4 (v·h) 4π/|Ω| with v·h at least 1e-3, by which GGX's
// α²/(1-α²) grows by 2/λ' (1-α² at least 1e-6) and a Phong exponent n becomes n λ'/(n+λ').
glm::dvec3 shade_filtered(const Surface& surface, const gpu::FilteredLight& light);

// A virtual spherical light's ∫ρ(ω)V(ω)dω / (πr²) [VSGL14 Eq. 2] over the cone of half angle asin(r/d), π/2
// inside the sphere, by adaptive quadrature to `relative_error`, or as near as 200 thousand evaluations come.
// 0 for a light of no power or radius.
Integral shade_vsl(const Surface& surface, const gpu::Vpl& light, double relative_error);

}  // namespace vsglbench::exact
