// Shading in double precision on the host: one light at one surface, without visibility. Written from the
// papers, not from the GLSL of this folder, of which it is the oracle: of the pixels' kernel, of random
// testing and of the stability suite. It keeps the kernel's stated conventions (floors, black lights), so
// that a difference is one of arithmetic. Sources: [MFIS16] App. C, [VSGL15s] App. A–B, [VSGL14 Eq. 1];
// Walter et al. 2007, Heitz 2014 (masking).
#pragma once

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

// f(l,v) n·l of Lambert and one microfacet lobe, 1/sr; zero unless both directions are above the shading
// normal's horizon and l above the face's.
glm::dvec3 brdf_cosine(const Surface& surface, const glm::dvec3& l);

struct VsglShading {
  DiffuseKernel diffuse = DiffuseKernel::cosine;
  bool disk = false;        // σ² counts half
  bool quadrature = false;  // L(v,κ) itself, instead of `diffuse`
};

// Reflected radiance, W/(m² sr), of a light's both lobes [MFIS16 App. C]; 0 for a light of no power.
// Conventions: n·v is 0.01 at least; the squared distance is 1e-20 m² at least; σ² is the squared distance ×
// 2^-41 at least, so that λ_σ <= 2^41; every diffuse kernel but pettineo-hill is held to [0,1], and
// pettineo-hill's sharpness to 1e-6 at least.
glm::dvec3 shade_vsgl(const Surface& surface, const gpu::Vsgl& light, const VsglShading& shading);

// Φ f(x2) f(x1) cos cos / d² [VSGL14 Eq. 1]; 0 for a light of no power, or at the surface itself.
glm::dvec3 shade_vpl(const Surface& surface, const gpu::Vpl& light);

}  // namespace vsglbench::exact
