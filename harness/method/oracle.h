// For tests and the conformance kit: generation in double precision on the host, written from the paper's own
// sums (App. B) and not from the kernels, which keep central moments.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "method/method.h"
#include "shaders/types.h"

namespace vsglbench::oracle {

// One texel as the deferred targets hold it.
struct Texel {
  glm::vec3 position{0}, normal{0, 1, 0}, geometric_normal{0, 1, 0}, diffuse{0}, f0{0};
  float ndf = 1;
  bool surface = true;
};

struct Half {
  gpu::Emitter emitter{};
  std::vector<Texel> texels;  // row-major
  std::vector<float> pdf;     // level 0, any scale
};

// Sums over VPLs, as [MFIS16 App. B] writes them; linear, so that filtering is a weighted sum.
struct Sums {
  glm::dvec3 diffuse{0}, specular{0};                      // ΣΦR per channel
  glm::dvec3 diffuse_direction{0}, specular_direction{0};  // Σ lum(ΦR) λ/(λ+1) ξ
  glm::dvec3 position{0};                                  // Σ w y
  double square = 0;                                       // Σ w (|y|² + texel's own variance)
  Sums& add(const Sums& o, double factor);
};

Sums texel_sums(const Half& half, uint32_t x, uint32_t y);
glm::dvec3 texel_flux(const gpu::Emitter& emitter, uint32_t x, uint32_t y);

struct Vsgl {
  glm::dvec3 mean{0}, diffuse{0}, diffuse_axis{0}, specular{0}, specular_axis{0};
  double variance = 0, diffuse_sharpness = 0, specular_sharpness = 0, power = 0, level = 0;
};
Vsgl make_vsgl(const Sums& sums, double factor);

// Means over blocks of 2^l × 2^l base texels, cut off at the image's edge.
class Pyramid {
 public:
  explicit Pyramid(const Half& half);
  uint32_t top() const { return static_cast<uint32_t>(levels_.size()) - 1; }
  double pdf(double px, double py, double level) const;  // trilinear, of mean 1
  Sums sums(double px, double py, double level) const;   // trilinear means
  glm::uvec2 warp(double ux, double uy) const;           // the chosen base texel

 private:
  struct Level {
    uint32_t width, height;
    std::vector<double> pdf;
    std::vector<Sums> sums;
  };
  template <class Value, class Get>
  Value bilinear(double px, double py, uint32_t level, const Get& get) const;
  double mass(uint32_t level, uint32_t x, uint32_t y) const;
  uint32_t width_, height_;
  std::vector<Level> levels_;
};

// Light `i` of `count` by filtered importance sampling [MFIS16 Eq. 1–5, Alg. 1], by one of LightRule's two
// rules for it; `fixed` is its lattice point in 32-bit fixed point.
Vsgl filtered_light(const Half& half, const Pyramid& pyramid, LightRule rule, double k, uint32_t count,
                    glm::uvec2 fixed);

double luminance(const glm::dvec3& c);

}  // namespace vsglbench::oracle
