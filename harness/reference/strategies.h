// The three ways to find a path light -> x1 -> x2 -> eye, and the weight that combines them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "reference/footprint.h"
#include "reference/light_guide.h"
#include "reference/ray_stream.h"
#include "reference/receiver_group.h"
#include "reference/reference.h"

namespace vsglbench {

// Samples a batch takes: of a pixel, and of the whole image. 0 switches a strategy off.
struct SampleCounts {
  uint32_t light = 0;     // a pixel
  uint32_t receiver = 0;  // a pixel whose BRDF is sharp; a quarter (rounded up) of it elsewhere
  uint32_t photons = 0;   // the image
};

// Radiance that a photon brings to a pixel.
struct Splat {
  uint32_t pixel = 0;
  glm::vec3 radiance{0};
};

// Every sample, whatever strategy found it, contributes f/sum(n_i p_i): the balance heuristic (Veach 1997,
// §9.2.2). With all densities over the product of the image plane of the light, mapped onto x1, and of area
// at x2, k the inverse of the footprint's area, and p_L = d(u,v)/dA at x1:
//   f         k Phi p_L f1 cos1 f2 cos2 / d^2     Phi the flux density over (u,v), cos2 of the shading normal
//   light     p = k p_L g                         g the tile's LightGuide density
//   receiver  p = k p_brdf(x2 -> x1) cos_g1 / d^2
//   emitter   p = p_L g p_brdf(x1 -> x2) cos_g2 / d^2   with the photons' own g
// All are divided by k p_L before they are computed, so that a scene of a micrometre overflows nothing.
// `light` and `receiver` are exact at the pixel's centre; `emitter` averages over the pixel's footprint.
// cos1 is of x1's shading normal towards x2 (ShadingNormals::light), or of the geometric one, and Phi then
// times (n.l)/(n_g.l), l towards the light (ShadingNormals::camera; Veach 1997 §5.3).
class Strategies {
 public:
  Strategies(const Tracer& tracer, const ImagePlane& camera, uint32_t width, uint32_t height,
             const ReferenceParameters& parameters, const std::vector<Footprint>& footprints);

  // Row `row` of the pool of x1 that `light` draws from in this batch: pool_size()^2 cells of the light's
  // plane, each with one ray at a jittered place.
  void trace_pool_row(uint32_t row, uint32_t batch, RayStream& rays);
  uint32_t pool_size() const { return 1u << pool_bits_; }

  // Aims photons at what the pool found of sharp lobes. Returns the share of photons, if spread evenly, that
  // would leave by one; nothing if no ray of the pool meets a surface.
  std::optional<double> aim_photons();

  // Must be set before anything below, and chooses the pool's size.
  void set_counts(const SampleCounts& counts);

  // Samples of `light` that a point of the pool serves at most, on average, so that its share of the noise of
  // the image's mean stays small; and the pool's largest size, 2^10 x 2^10, 128 MiB.
  static constexpr double connections_a_point = 32;
  static constexpr uint32_t most_pool_bits = 10;

  LightGuide& guide() { return guide_; }
  const LightGuide& photon_guide() const { return photon_guide_; }
  void follow(const Guidance& guidance) { guide_ = guidance.light, photon_guide_ = guidance.photons; }

  // `light` and `receiver` for the pixels of one tile of the guide in one batch: writes each one's part of
  // the radiance to estimate[pixel], 0 where there is no surface, and teaches the guide if asked to.
  void gather(uint32_t tile, uint32_t batch, bool teach, RayStream& rays, glm::vec3* estimate);

  // `emitter`: photons [first, last) of one batch; appends their splats.
  void emit(uint32_t first, uint32_t last, uint32_t batch, RayStream& rays, std::vector<Splat>* splats) const;

 private:
  // x1: a surface as the light sees it. Two cache lines.
  struct alignas(64) Emitter {
    glm::vec3 position{0};
    float density = 0;        // p_L, 1/m^2; 0: the light's ray met nothing
    Brdf brdf;                // and the normals, towards the light
    float flux = 0;           // over (u,v), relative to axis_flux_
    uint32_t cell = 0;        // of the LightGuide
    glm::vec3 ray_origin{0};  // `position`, moved off the surface towards the light
  };
  // What a group of pixels found, to teach the guide with.
  struct Lesson {
    struct Found {
      uint32_t lane, cell;
      float luminance;
    };
    std::vector<Found> found;
    float total[ReceiverGroup::width] = {};
  };
  // x2: a point of a pixel's footprint.
  struct Receiver {
    const Footprint* footprint;
    glm::vec3 position;
    float kernel;            // 1/m^2
    float geometric_cosine;  // with the direction to x1; < 0: that of the footprint's normal
  };

  uint32_t receiver_samples(const Footprint& x2) const {
    return x2.brdf.sharpness() > 0 ? counts_.receiver : (counts_.receiver + 3) / 4;
  }
  Emitter make_emitter(const Hit& hit, const glm::vec2& uv, const glm::vec3& to_light, float distance) const;
  void gather_block(uint32_t x, uint32_t y, uint32_t batch, bool teach, RayStream& rays, glm::vec3* estimate);
  void gather_light(const ReceiverGroup& group, uint32_t tile, const glm::uvec3& shift, bool teach,
                    RayStream& rays, glm::vec3* estimate);
  glm::vec3 gather_receiver(uint32_t pixel, uint32_t batch, RayStream& rays) const;
  Emitter trace_emitter(const glm::vec2& uv, RayStream& rays) const;
  const Emitter& choose(uint32_t tile, const glm::uvec3& bits) const;
  uint32_t connect_light(const ReceiverGroup& group, const Emitter& x1, RayStream& rays) const;
  glm::vec3 contribution(const Emitter& x1, const Receiver& x2) const;
  glm::vec3 from_receiver(const Footprint& x2, const glm::vec3& random, RayStream& rays) const;
  glm::vec3 connect_receiver(const Footprint& x2, const glm::vec3& direction, const Hit& hit,
                             RayStream& rays) const;
  bool land(const Emitter& x1, const glm::vec3& direction, const Hit& hit, RayStream& rays,
            Splat* splat) const;

  const Tracer& tracer_;
  ImagePlane light_, camera_;
  glm::vec3 axis_flux_;  // flux density over (u,v) on the light's axis, W
  uint32_t width_, height_;
  uint64_t seed_;
  bool occlusion_;
  ShadingNormals shading_normals_;
  SampleCounts counts_;
  const std::vector<Footprint>& footprints_;
  uint32_t pool_bits_ = LightGuide::cell_bits + 1;
  std::vector<Emitter> pool_;
  LightGuide guide_;         // of `light`
  LightGuide photon_guide_;  // of `emitter`: one tile, whose flux x sharpness it follows
};

}  // namespace vsglbench
