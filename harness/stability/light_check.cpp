#include "stability/light_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "method/lattice.h"
#include "shaders/sg_exact.h"

namespace vsglbench {
namespace {

using glm::dvec3;

constexpr double kUlp = 0x1p-23;
constexpr double kAngle = 0x1p-47;             // ½|ξ-ξ'|² of directions that are one rounding apart
constexpr uint32_t kBorder = 1u << 12;         // of a lattice point in 32-bit fixed point: 2^-20
constexpr double kBisectionStep = 2.0 / 4096;  // of the top level

// What a light stands for, in numbers that have no trouble at their ends.
struct Aggregate {
  dvec3 diffuse{0}, specular{0};                      // power, W
  dvec3 diffuse_direction{0}, specular_direction{0};  // r ξ
  double diffuse_q = 1, specular_q = 1;               // 1-r
  dvec3 mean{0};
  double variance = 0;
};

// A lobe of sharpness λ and mean direction length λ/(λ+1) [MFIS16 App. B.1].
double mean_length(double sharpness) { return sharpness / (sharpness + 1); }

Aggregate aggregate(const oracle::Vsgl& v) {
  Aggregate a;
  a.diffuse = v.diffuse * exact::sg_integral(v.diffuse_sharpness);
  a.specular = v.specular * exact::sg_integral(v.specular_sharpness);
  a.diffuse_direction = mean_length(v.diffuse_sharpness) * v.diffuse_axis;
  a.specular_direction = mean_length(v.specular_sharpness) * v.specular_axis;
  a.diffuse_q = 1 / (v.diffuse_sharpness + 1);
  a.specular_q = 1 / (v.specular_sharpness + 1);
  a.mean = v.mean;
  a.variance = v.variance;
  return a;
}

oracle::Vsgl widened(const gpu::Vsgl& v) {
  return {v.mean,     v.diffuse,           v.diffuse_axis,       v.specular, v.specular_axis,
          v.variance, v.diffuse_sharpness, v.specular_sharpness, v.power,    v.level};
}

// The largest relative error and its field.
struct Difference {
  double error = 0;
  const char* field = "";
  void see(const char* name, double e) {
    if (e <= error) return;  // a NaN is found out by the records' own check
    error = e;
    field = name;
  }
};

Difference difference(const Aggregate& g, const Aggregate& c) {
  Difference d;
  const double power = oracle::luminance(c.diffuse) + oracle::luminance(c.specular);
  const auto largest = [](const dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
  d.see("diffuse power", largest(g.diffuse - c.diffuse) / power);
  d.see("specular power", largest(g.specular - c.specular) / power);
  const auto lobe = [&](const char* name, const dvec3& a, double qa, const dvec3& b, double qb,
                        double share) {
    if (share < 1e-6) return;  // a lobe without power has no direction
    d.see(name, glm::length(a - b));
    d.see(name, std::abs(qa - qb) / (qb + kAngle / kOkError));
  };
  lobe("diffuse lobe", g.diffuse_direction, g.diffuse_q, c.diffuse_direction, c.diffuse_q,
       oracle::luminance(c.diffuse) / power);
  lobe("specular lobe", g.specular_direction, g.specular_q, c.specular_direction, c.specular_q,
       oracle::luminance(c.specular) / power);
  const double unheld = kUlp * glm::length(c.mean);
  d.see("mean", glm::length(g.mean - c.mean) / (std::sqrt(c.variance) + unheld / kOkError));
  d.see("variance", std::abs(g.variance - c.variance) / (c.variance + 1e-20 / kOkError));
  return d;
}

// Light i as the paper's rule makes it, from the texel that `fixed` warps to.
Difference filtered_difference(const LightsAsked& asked, const oracle::Pyramid& pyramid, LightRule rule,
                               uint32_t count, glm::uvec2 fixed, const gpu::Vsgl& light) {
  const double k = asked.parameters.at("K").get<double>();
  const oracle::Vsgl whole = oracle::filtered_light(asked.half, pyramid, rule, k, count, fixed);
  const gpu::Emitter& e = asked.half.emitter;
  const glm::dvec2 u = unit_interval(fixed);
  const glm::uvec2 t = pyramid.warp(u.x, u.y);
  const double x = t.x + 0.5, y = t.y + 0.5, texels = double(e.width) * e.height;
  const double level = std::clamp<double>(light.level, 0, pyramid.top());
  const double share = rule == LightRule::pdf_at_centre ? 1 / std::max(count * pyramid.pdf(x, y, 0), 1.0)
                                                        : 1 / (count * pyramid.pdf(x, y, level));
  const oracle::Vsgl here = oracle::make_vsgl(pyramid.sums(x, y, level), share * texels);
  Difference d;
  if (!(here.power > 0)) {
    d.see("power", light.power > 0 ? std::numeric_limits<double>::infinity() : 0);
  } else {
    d = difference(aggregate(widened(light)), aggregate(here));
  }
  d.see("level", std::max(0.0, std::abs(whole.level - level) - kBisectionStep * pyramid.top()));
  return d;
}

void check_filtered(const LightsAsked& asked, LightRule rule, const LightRecords& lights,
                    Judgement* verdict) {
  const oracle::Pyramid pyramid(asked.half);
  const auto count = static_cast<uint32_t>(lights.count());
  for (uint32_t i = 0; i < count; ++i) {
    const glm::uvec2 fixed = lattice_point(i, count, asked.shift);
    const auto against = [&](glm::uvec2 point) {
      return filtered_difference(asked, pyramid, rule, count, point, lights.at<gpu::Vsgl>(i));
    };
    Difference least = against(fixed);
    for (const int dx : {-1, 0, 1}) {
      for (const int dy : {-1, 0, 1}) {
        if (least.error <= kOkError) continue;
        const Difference d = against(fixed + glm::uvec2(kBorder) * glm::uvec2(dx, dy));
        if (d.error < least.error) least = d;
      }
    }
    verdict->error(least.error, fmt::format("light {}", i), least.field);
  }
}

// The variance of a texel alone, m²; infinity for one without power.
double own_variance(const oracle::Sums& texel) {
  const oracle::Vsgl v = oracle::make_vsgl(texel, 1);
  return v.power > 0 ? v.variance : std::numeric_limits<double>::infinity();
}

// All lights together against all texels together; and none smaller than a texel.
void check_sum(const LightsAsked& asked, const LightRecords& lights, Judgement* verdict) {
  oracle::Sums made, texels;
  for (size_t i = 0; i < lights.count(); ++i) {
    const oracle::Vsgl v = widened(lights.at<gpu::Vsgl>(i));
    if (!(v.power > 0)) continue;
    const Aggregate a = aggregate(v);
    const double wd = oracle::luminance(a.diffuse), ws = oracle::luminance(a.specular), w = wd + ws;
    made.add({a.diffuse, a.specular, wd * a.diffuse_direction, ws * a.specular_direction, w * a.mean,
              w * (glm::dot(a.mean, a.mean) + a.variance)},
             1);
  }
  const gpu::Emitter& e = asked.half.emitter;
  double least = std::numeric_limits<double>::infinity();
  for (uint32_t y = 0; y < e.height; ++y) {
    for (uint32_t x = 0; x < e.width; ++x) {
      const oracle::Sums texel = oracle::texel_sums(asked.half, x, y);
      least = std::min(least, own_variance(texel));
      texels.add(texel, 1);
    }
  }
  for (size_t i = 0; i < lights.count(); ++i) {
    if (const gpu::Vsgl v = lights.at<gpu::Vsgl>(i); v.power > 0)
      verdict->error(1 - v.variance / least, fmt::format("light {}", i), "variance below any texel's");
  }
  const Difference d =
      difference(aggregate(oracle::make_vsgl(made, 1)), aggregate(oracle::make_vsgl(texels, 1)));
  verdict->error(d.error, "all lights", d.field);
}

// The texel that a VPL can be, and by how much it is not.
Difference texel_difference(const LightsAsked& asked, const gpu::Vpl& light, size_t i, double flux_scale) {
  const oracle::Texel& t = asked.half.texels[i];
  const gpu::Emitter& e = asked.half.emitter;
  Difference d;
  if (light.normal != t.normal || light.geometric_normal != t.geometric_normal ||
      light.diffuse != t.diffuse || light.f0 != t.f0 || light.ndf != t.ndf) {
    d.see("material", std::numeric_limits<double>::infinity());
  }
  const dvec3 to = dvec3(e.position) - dvec3(t.position);
  const dvec3 incident = e.perspective ? glm::normalize(to) : -dvec3(e.forward);
  d.see("incident", glm::length(dvec3(light.incident) - incident));
  if (flux_scale > 0) {
    const auto width = static_cast<size_t>(e.width);
    const dvec3 flux = flux_scale * oracle::texel_flux(e, static_cast<uint32_t>(i % width),
                                                       static_cast<uint32_t>(i / width));
    d.see("flux", glm::length(dvec3(light.flux) - flux) / glm::length(flux));
  }
  return d;
}

void check_vpls(const LightsAsked& asked, const std::vector<gpu::Vpl>& lights, Judgement* verdict) {
  const oracle::Half& half = asked.half;
  double mean = 0;
  for (const float p : half.pdf) mean += p / static_cast<double>(half.pdf.size());
  for (size_t i = 0; i < lights.size(); ++i) {
    const gpu::Vpl& light = lights[i];
    if (!(light.power > 0)) continue;
    Difference least{std::numeric_limits<double>::infinity(), "no texel lies there"};
    for (size_t t = 0; t < half.texels.size(); ++t) {
      if (!half.texels[t].surface || half.texels[t].position != light.position) continue;
      double scale = 0;  // how many texels' flux the light carries, where that is known
      if (asked.method.light_rule == LightRule::texel) {
        scale = asked.method.takes_light_count
                    ? mean / (static_cast<double>(lights.size()) * half.pdf[t]) * half.texels.size()
                    : 1;
      }
      const Difference d = texel_difference(asked, light, t, scale);
      if (d.error < least.error) least = d;
    }
    verdict->error(least.error, fmt::format("light {}", i), least.field);
  }
}

}  // namespace

void check_lights(const LightsAsked& asked, const LightRecords& lights, Judgement* verdict) {
  if (const std::string fault = first_fault(lights, asked.powerless); !fault.empty()) verdict->bad(fault);
  if (asked.powerless || verdict->is_bad()) return;
  const LightRule rule = asked.method.light_rule;
  if (const auto vpls = lights.all<gpu::Vpl>(); !vpls.empty()) return check_vpls(asked, vpls, verdict);
  if (lights.kind != LightKind::vsgl) return;
  if (rule == LightRule::pdf_at_centre || rule == LightRule::equal_probability) {
    check_filtered(asked, rule, lights, verdict);
  } else if (asked.method.flux_bound <= 1e-3) {
    check_sum(asked, lights, verdict);
  }
}

void check_energy(const MethodInfo& method, double mean, double standard_error, Judgement* verdict) {
  const double off = std::abs(mean - 1);
  if (off <= method.flux_bound + 3 * standard_error) return;
  verdict->bias(fmt::format("the lights carry {:.4g} × the texels' power ± {:.1g}; flux_bound is {:g}", mean,
                            standard_error, method.flux_bound));
}

}  // namespace vsglbench
