#include "stability/shading_check.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace vsglbench {
namespace {

using glm::dvec3;

constexpr double kRounding = 0x1p-23;
constexpr int kPerturbations = 4;
constexpr double kLeastRadiance = 1.18e-38 / kOkError;  // below it, single precision has no full digits

exact::Surface surface_of(const oracle::Half& half, size_t i) {
  const oracle::Texel& t = half.texels[i];
  const dvec3 position(t.position);
  const dvec3 view = half.emitter.perspective ? glm::normalize(dvec3(half.emitter.position) - position)
                                              : -dvec3(half.emitter.forward);
  return {position,
          glm::normalize(dvec3(t.normal)),
          glm::normalize(dvec3(t.geometric_normal)),
          view,
          dvec3(t.diffuse),
          dvec3(t.f0),
          t.ndf};
}

dvec3 shade(const exact::Surface& s, const gpu::Vsgl& light, const exact::VsglShading& shading) {
  return exact::shade_vsgl(s, light, shading);
}
dvec3 shade(const exact::Surface& s, const gpu::Vpl& light, const exact::VsglShading&) {
  return exact::shade_vpl(s, light);
}
dvec3 shade(const exact::Surface& s, const gpu::FilteredLight& light, const exact::VsglShading&) {
  return exact::shade_filtered(s, light);
}

// Numbers that are off by up to one rounding.
class Noise {
 public:
  explicit Noise(uint32_t seed) : random_(seed) {}
  double factor() { return 1 + kRounding * signed_unit(); }
  dvec3 vector() {
    const double x = signed_unit(), y = signed_unit(), z = signed_unit();
    return kRounding * dvec3(x, y, z);
  }
  // Single precision can't hold a rounding of itself: two of them instead.
  void turn(glm::vec3* v) { *v = glm::vec3(dvec3(*v) + 2.0 * vector()); }
  void scale(float* v) { *v *= static_cast<float>(1 + 2 * kRounding * signed_unit()); }

 private:
  double signed_unit() { return static_cast<double>(random_()) * 0x1p-31 - 1; }
  std::mt19937 random_;
};

exact::Surface rounded(exact::Surface s, double distance, Noise& noise) {
  s.position += distance * noise.vector();
  s.normal = glm::normalize(s.normal + noise.vector());
  s.geometric_normal += noise.vector();
  s.view = glm::normalize(s.view + noise.vector());
  s.ndf *= noise.factor();
  return s;
}

gpu::Vsgl rounded(gpu::Vsgl l, Noise& noise) {
  noise.turn(&l.diffuse_axis);
  noise.turn(&l.specular_axis);
  noise.scale(&l.diffuse_sharpness);
  noise.scale(&l.specular_sharpness);
  return l;
}
gpu::Vpl rounded(gpu::Vpl l, Noise& noise) {
  noise.turn(&l.normal);
  noise.turn(&l.geometric_normal);
  noise.turn(&l.incident);
  noise.scale(&l.ndf);
  return l;
}
gpu::FilteredLight rounded(gpu::FilteredLight l, Noise& noise) {
  noise.turn(&l.normal);
  noise.turn(&l.incident);
  noise.scale(&l.ndf);
  return l;
}

const glm::vec3& position_of(const gpu::FilteredLight& l) { return l.mean; }
const glm::vec3& position_of(const gpu::Vsgl& l) { return l.mean; }
const glm::vec3& position_of(const gpu::Vpl& l) { return l.position; }

// All lights at the surfaces of a half.
template <class Light>
class Exactly {
 public:
  Exactly(std::vector<Light> lights, const exact::VsglShading& shading)
      : lights_(std::move(lights)), shading_(shading) {}
  dvec3 radiance(const exact::Surface& s) const {
    dvec3 sum(0);
    for (const Light& light : lights_) sum += shade(s, light, shading_);
    return sum;
  }
  // m of check_shading(): what one surface adds to it.
  dvec3 usual(const exact::Surface& s, const dvec3& radiance) const {
    if (shading_.diffuse == exact::DiffuseModel::cosine) return glm::abs(radiance);
    dvec3 sum(0);
    for (const Light& light : lights_) {
      exact::Surface turned = s;
      turned.f0 = dvec3(0);
      turned.normal = turned.view = glm::normalize(dvec3(position_of(light)) - s.position + dvec3(1e-30));
      sum += glm::abs(shade(turned, light, shading_));
    }
    return glm::max(glm::abs(radiance), sum);
  }
  // Σ over lights of the largest change by roundings.
  dvec3 sensitivity(const exact::Surface& s) const {
    Noise noise(7);
    dvec3 sum(0);
    for (const Light& light : lights_) {
      const dvec3 here = shade(s, light, shading_);
      const double distance = glm::length(dvec3(position_of(light)) - s.position);
      dvec3 most(0);
      for (int k = 0; k < kPerturbations; ++k) {
        const dvec3 there = shade(rounded(s, distance, noise), rounded(light, noise), shading_);
        most = glm::max(most, glm::abs(there - here));
      }
      sum += most;
    }
    return sum;
  }

 private:
  std::vector<Light> lights_;
  exact::VsglShading shading_;
};

struct Pixel {
  std::string name;
  glm::vec3 value;
  dvec3 exact;
};

// What no radiance is, whatever the lights are; empty: nothing.
std::string impossible(const Pixel& p, bool black) {
  for (int c = 0; c < 3; ++c) {
    if (!std::isfinite(p.value[c])) return fmt::format("{} is {}", p.name, p.value[c]);
    if (p.value[c] < 0 && !(p.exact[c] < 0)) return fmt::format("{} is negative, {:.3g}", p.name, p.value[c]);
    if (black && p.value[c] != 0) return fmt::format("{} is {:.3g} but must be black", p.name, p.value[c]);
  }
  return "";
}

double relative(const Pixel& p, int c, const dvec3& floor) {
  const double difference = std::abs(p.value[c] - p.exact[c]);
  return difference == 0 ? 0 : difference / (std::abs(p.exact[c]) + floor[c] + kLeastRadiance);
}

template <class Light>
void check(const oracle::Half& receivers, std::span<const glm::vec3> pixels, const Exactly<Light>& exactly,
           bool black, Judgement* verdict) {
  std::vector<Pixel> all;
  std::vector<exact::Surface> surfaces;
  dvec3 mean(0);
  for (size_t i = 0; i < pixels.size(); ++i) {
    if (!receivers.texels[i].surface) continue;
    surfaces.push_back(surface_of(receivers, i));
    const std::string name =
        fmt::format("pixel ({},{})", i % receivers.emitter.width, i / receivers.emitter.width);
    all.push_back({name, pixels[i], exactly.radiance(surfaces.back())});
    mean += exactly.usual(surfaces.back(), all.back().exact);
  }
  mean /= std::max<double>(1, static_cast<double>(all.size()));
  for (size_t i = 0; i < all.size(); ++i) {
    const Pixel& p = all[i];
    if (const std::string fault = impossible(p, black); !fault.empty()) verdict->bad(fault);
    dvec3 floor = 0.01 * mean;
    if (std::max({relative(p, 0, floor), relative(p, 1, floor), relative(p, 2, floor)}) > kOkError) {
      floor += 1 / kOkError * exactly.sensitivity(surfaces[i]);
    }
    for (int c = 0; c < 3; ++c) {
      verdict->error(relative(p, c, floor), p.name,
                     fmt::format("{:.5g} instead of {:.5g}", p.value[c], p.exact[c]));
      if (p.exact[c] < 0) verdict->bias(p.name + ": the formula itself is negative");
    }
  }
}

// The check of lights whose shading has no value to compare with.
void check_possible(std::span<const glm::vec3> pixels, bool black, Judgement* verdict) {
  verdict->note("pixels have no double form: looked at for NaN, Inf and sign");
  for (size_t i = 0; i < pixels.size(); ++i) {
    const std::string fault = impossible({fmt::format("pixel {}", i), pixels[i], dvec3(0)}, black);
    if (!fault.empty()) verdict->bad(fault);
  }
}

}  // namespace

void check_shading(const oracle::Half& receivers, std::span<const glm::vec3> pixels,
                   const LightRecords& lights, std::vector<gpu::FilteredLight> filtered,
                   const std::optional<exact::VsglShading>& shading, bool black, Judgement* verdict) {
  if (!filtered.empty()) {
    check(receivers, pixels, Exactly(std::move(filtered), {}), black, verdict);
  } else if (lights.kind == LightKind::vsgl && shading) {
    check(receivers, pixels, Exactly(lights.all<gpu::Vsgl>(), *shading), black, verdict);
  } else if (lights.kind == LightKind::vpl) {
    check(receivers, pixels, Exactly(lights.all<gpu::Vpl>(), {}), black, verdict);
  } else {
    check_possible(pixels, black, verdict);
  }
}

}  // namespace vsglbench
