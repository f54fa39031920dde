#include <algorithm>
#include <cmath>

#include "method/made_half.h"
#include "stability/hard_cases.h"

namespace vsglbench {
namespace {

constexpr uint32_t kWidth = 16, kHeight = 12;

HalfCase gentle() { return {.half = smooth_half(kWidth, kHeight)}; }

HalfCase with_lights(uint32_t count) {
  HalfCase c = gentle();
  c.lights = count;
  return c;
}

template <class Change>
HalfCase changed(HalfCase c, const Change& change) {
  for (size_t i = 0; i < c.half.texels.size(); ++i) change(c.half.texels[i], i);
  return c;
}

// The PDF that a frame would have, after materials have changed: what each texel reflects.
HalfCase with_reflected_pdf(HalfCase c) {
  const uint32_t w = c.half.emitter.width;
  for (size_t i = 0; i < c.half.pdf.size(); ++i) {
    const auto s = oracle::texel_sums(c.half, static_cast<uint32_t>(i % w), static_cast<uint32_t>(i / w));
    c.half.pdf[i] = static_cast<float>(oracle::luminance(s.diffuse) + oracle::luminance(s.specular));
  }
  return c;
}

// All of it moved by the same way, which no result but the positions may show.
HalfCase far_from_origin(float metres) {
  HalfCase c = changed(gentle(), [&](oracle::Texel& t, size_t) { t.position += glm::vec3(metres); });
  c.half.emitter.position += glm::vec3(metres);
  return c;
}

// All texels drawn together to `scale` of their distances, round a point under the emitter.
HalfCase shrunk(float scale) {
  HalfCase c = gentle();
  const glm::vec3 centre = c.half.emitter.position - glm::vec3(0, 4, 0);
  return changed(std::move(c),
                 [&](oracle::Texel& t, size_t) { t.position = centre + scale * (t.position - centre); });
}

HalfCase one_texel_clusters() {
  HalfCase c = gentle();
  c.lights = kWidth * kHeight;
  c.half.emitter.extent *= 1e-4f;  // footprints of 1e-10 m²
  return c;
}

// Sharpnesses 0 to 2^41, one a texel and log-uniform, and N = texels; and in each second row normals that
// cancel out.
HalfCase sharpnesses() {
  HalfCase c = with_lights(kWidth * kHeight);
  c.receivers = [](const oracle::Half& half, const auto& spots) {
    return glossy_receivers(half, spots, 0.3f);
  };
  const glm::vec3 emitter = c.half.emitter.position;
  c = changed(std::move(c), [&](oracle::Texel& t, size_t i) {
    // Mean diffuse directions of length near 0: neighbours face each other.
    if (i / kWidth % 2 == 1) t.normal = glm::normalize(glm::vec3(i % 2 ? 1 : -1, 1e-3f, 0));
    t.geometric_normal = glm::vec3(0, 1, 0);
    t.f0 = glm::vec3(0.5f);
    // λs = λh/(4 cos) [VSGL15s App. A].
    const float cosine = std::max(glm::dot(t.normal, glm::normalize(emitter - t.position)), 1e-3f);
    const double u = static_cast<double>(i % kWidth) / (kWidth - 1);
    t.ndf = -4 * cosine * static_cast<float>(std::exp2(-20 + 60.99 * u));
  });
  return with_reflected_pdf(std::move(c));
}

HalfCase glossy(float emitter, float receiver) {
  HalfCase c = changed(gentle(), [&](oracle::Texel& t, size_t) {
    t.ndf = emitter;
    t.f0 = glm::vec3(0.6f, 0.5f, 0.4f);
  });
  c.receivers = [=](const oracle::Half& half, const auto& spots) {
    return glossy_receivers(half, spots, receiver);
  };
  return with_reflected_pdf(std::move(c));
}

HalfCase at_lights(double sigmas, double metres) {
  HalfCase c = gentle();
  c.receivers = [=](const oracle::Half& half, const auto& spots) {
    return receivers_at_lights(half, spots, sigmas, metres);
  };
  return c;
}

HalfCase at_angles(double light_cosine, double view_cosine) {
  HalfCase c = shrunk(1e-2f);
  c.receivers = [=](const oracle::Half& half, const auto& spots) {
    return receivers_at_angles(half, spots, light_cosine, view_cosine);
  };
  return c;
}

// The primary light grazes every texel: its footprints are as large as they can be.
HalfCase grazing_primary() {
  HalfCase c = gentle();
  const glm::vec3 emitter = c.half.emitter.position;
  c = changed(std::move(c), [&](oracle::Texel& t, size_t) {
    const glm::vec3 view = glm::normalize(emitter - t.position);
    t.geometric_normal = glm::normalize(glm::cross(view, glm::vec3(0, 0, 1)) + 1e-4f * view);
    t.normal = t.geometric_normal;
  });
  return with_reflected_pdf(std::move(c));
}

HalfCase of_power(float power) {
  HalfCase c = gentle();
  c.half.emitter.power = power * glm::vec3(1, 0.8f, 0.6f);
  return c;
}

HalfCase with_pdf(float chosen, float rest) {
  HalfCase c = gentle();
  std::fill(c.half.pdf.begin(), c.half.pdf.end(), rest);
  c.half.pdf[(kHeight / 2) * kWidth + kWidth / 2] = chosen;
  c.no_pdf = chosen == 0 && rest == 0;
  return c;
}

HalfCase with_footprint_size(double k) {
  HalfCase c = gentle();
  c.footprint_size = k;
  return c;
}

HalfCase of_size(uint32_t width, uint32_t height, uint32_t count) {
  HalfCase c{.half = smooth_half(width, height)};
  c.lights = count;
  return c;
}

HalfCase sees_nothing() {
  HalfCase c = changed(gentle(), [](oracle::Texel& t, size_t) { t.surface = false; });
  std::fill(c.half.pdf.begin(), c.half.pdf.end(), 0.0f);
  c.no_surface = true;
  return c;
}

HalfCase black_light() {
  HalfCase c = of_power(0);
  c.no_flux = true;
  return c;
}

// Each second column drawn together to a millionth of the others' distances.
HalfCase two_scales() {
  HalfCase c = gentle();
  const glm::vec3 centre = c.half.emitter.position - glm::vec3(0, 4, 0);
  return changed(std::move(c), [&](oracle::Texel& t, size_t i) {
    const float scale = i % 2 ? 1e3f : 1e-3f;
    t.position = centre + scale * (t.position - centre) * glm::vec3(1, 1e-2f, 1);
  });
}

HardCase of(const std::string& name, const std::string& what, std::function<HalfCase()> half) {
  return {.name = name, .what = what, .half = std::move(half)};
}

HardCase with_models(HardCase c) {
  c.models = true;
  return c;
}

}  // namespace

std::vector<HardCase> half_cases() {
  return {
      of("gentle", "none of the below: what the others are to be compared with", gentle),
      of("far-half", "emitter, texels and surfaces 1e3 m from the origin, not rebased",
         [] { return far_from_origin(1e3f); }),
      with_models(
          of("one-texel-clusters", "N = texels, each of 1e-10 m²: σ² is 0 but for that", one_texel_clusters)),
      of("one-point", "all texels at one point", [] { return shrunk(0); }),
      with_models(of("sharpness", "lobes of sharpness 0 to 2^41", sharpnesses)),
      of("phong-65535", "Phong exponent 65535 at emitter and receiver",
         [] { return glossy(-65535, -65535); }),
      of("mirror-half", "GGX α = 1e-3, the smallest there is, at emitter and receiver",
         [] { return glossy(1e-3f, 1e-3f); }),
      of("phong-1e7", "Phong exponent 1e7, the largest there is, at emitter and receiver",
         [] { return glossy(-1e7f, -1e7f); }),
      with_models(of("on-light", "shading points at a light's own position", [] { return at_lights(0, 0); })),
      with_models(of("in-light", "shading points 0.3 σ from a light", [] { return at_lights(0.3, 0); })),
      with_models(of("near-light", "shading points 1e-6 m from a light", [] { return at_lights(0, 1e-6); })),
      with_models(of("grazing-light", "light at a cosine of 1e-3", [] { return at_angles(1e-3, 0.5); })),
      of("grazing-view", "view at a cosine of 1e-3", [] { return at_angles(0.5, 1e-3); }),
      of("grazing-both", "light and view at cosines of 1e-3", [] { return at_angles(1e-3, 1e-3); }),
      of("grazing-primary", "the primary light grazes all texels, cosine 1e-4", grazing_primary),
      with_models(of("light-behind", "all lights behind the surface", [] { return at_angles(-0.5, 0.5); })),
      of("sees-nothing", "the primary light sees no surface", sees_nothing),
      of("black-light", "a primary light without flux", black_light),
      of("radiance-1e-20", "a primary light of 1e-20 W/sr", [] { return of_power(1e-20f); }),
      of("radiance-1e20", "a primary light of 1e20 W/sr", [] { return of_power(1e20f); }),
      of("pdf-zero", "a PDF that is zero everywhere", [] { return with_pdf(0, 0); }),
      of("pdf-one-texel", "a PDF that is zero but at one texel", [] { return with_pdf(1, 0); }),
      of("pdf-1e12", "a PDF that is 1e12 times the rest's at one texel", [] { return with_pdf(1e12f, 1); }),
      of("k-1e-6", "K = 1e-6", [] { return with_footprint_size(1e-6); }),
      of("k-1e6", "K = 1e6", [] { return with_footprint_size(1e6); }),
      of("n-1", "N = 1", [] { return with_lights(1); }),
      of("n-texels", "N = texels", [] { return with_lights(kWidth * kHeight); }),
      of("rsm-1x1", "an RSM of 1×1", [] { return of_size(1, 1, 1); }),
      of("rsm-1x4096", "an RSM of 1×4096", [] { return of_size(1, 4096, 16); }),
      of("two-scales-half", "texels of two sizes, 1e6 apart, side by side", two_scales),
  };
}

}  // namespace vsglbench
