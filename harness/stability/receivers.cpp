#include "stability/receivers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace vsglbench {
namespace {

using glm::dvec3;

constexpr uint32_t kWidth = 12, kHeight = 4;

class Draws {
 public:
  double uniform() { return static_cast<double>(random_()) * 0x1p-32; }
  glm::vec3 color() {
    const double r = uniform(), g = uniform(), b = uniform();
    return {r, g, b};
  }
  dvec3 direction() {
    const double z = 2 * uniform() - 1, p = 2 * std::numbers::pi * uniform(), r = std::sqrt(1 - z * z);
    return {r * std::cos(p), r * std::sin(p), z};
  }
  float ndf() {
    const double u = uniform(), v = uniform();
    return static_cast<float>(u < 0.5 ? 0.03 + 0.97 * v : -std::exp(8 * v));
  }

 private:
  std::mt19937 random_{11};
};

// Where the lights, or else the texels, lie.
struct Region {
  dvec3 centre{0};
  double radius = 0;  // m, at least 1 % of the way from the emitter
};

Region region_of(const oracle::Half& half, const std::vector<LightSpot>& spots) {
  std::vector<dvec3> points;
  for (const LightSpot& s : spots) points.push_back(s.position);
  if (points.empty()) {
    for (const oracle::Texel& t : half.texels) points.emplace_back(t.position);
  }
  Region r;
  for (const dvec3& p : points) r.centre += p / static_cast<double>(points.size());
  for (const dvec3& p : points) r.radius = std::max(r.radius, glm::length(p - r.centre));
  r.radius = std::max(r.radius, 0.01 * glm::length(dvec3(half.emitter.position) - r.centre));
  return r;
}

// The eye, and surfaces added one after the other.
class Receivers {
 public:
  explicit Receivers(const dvec3& eye) : eye_(eye) {
    half_.emitter = {.position = glm::vec3(eye),
                     .perspective = 1,
                     .forward = {0, 0, -1},
                     .width = kWidth,
                     .right = {1, 0, 0},
                     .height = kHeight,
                     .up = {0, 1, 0},
                     .footprint_cosine = 0.1f,
                     .extent = {1, 1},
                     .power = {1, 1, 1},
                     .importance = 1};
  }
  // Unit, from a surface at `position` to the eye.
  dvec3 view(const dvec3& position) const { return glm::normalize(eye_ - position); }
  bool full() const { return half_.texels.size() == size_t(kWidth) * kHeight; }
  void add(const dvec3& position, const dvec3& normal, const glm::vec3& diffuse, const glm::vec3& f0,
           float ndf) {
    oracle::Texel t;
    t.position = glm::vec3(position);
    t.normal = glm::vec3(glm::normalize(normal));
    t.geometric_normal = t.normal;
    t.diffuse = diffuse;
    t.f0 = f0;
    t.ndf = ndf;
    half_.texels.push_back(t);
  }
  oracle::Half take() {
    half_.pdf.assign(half_.texels.size(), 1);
    return std::move(half_);
  }

 private:
  dvec3 eye_;
  oracle::Half half_;
};

// A normal about the view, well on its side.
dvec3 seen_normal(const dvec3& view, Draws& draws) {
  const dvec3 n = glm::normalize(view + 0.9 * draws.direction());
  const double cosine = glm::dot(n, view);
  return cosine < 0.05 ? n + (0.1 - cosine) * view : n;
}

dvec3 beside(const oracle::Half& half, const Region& r) {
  const dvec3 up = glm::normalize(dvec3(half.emitter.position) - r.centre);
  return r.centre + r.radius * (2.0 * up + 2.5 * dvec3(half.emitter.right));
}

}  // namespace

std::vector<LightSpot> light_spots(const LightRecords& lights) {
  std::vector<LightSpot> spots;
  for (const LightSummary& light : summaries_of(lights)) {
    if (light.power > 0) spots.push_back({dvec3(light.position), std::sqrt(double(light.variance))});
  }
  return spots;
}

oracle::Half scattered_receivers(const oracle::Half& half, const std::vector<LightSpot>& spots) {
  const Region r = region_of(half, spots);
  const dvec3 up = glm::normalize(dvec3(half.emitter.position) - r.centre);
  Receivers receivers(beside(half, r));
  for (Draws draws; !receivers.full();) {
    const dvec3 p = r.centre + r.radius * (draws.direction() * draws.uniform() + 1.3 * up);
    const glm::vec3 diffuse = draws.color(), f0 = draws.color();
    receivers.add(p, seen_normal(receivers.view(p), draws), diffuse, f0, draws.ndf());
  }
  return receivers.take();
}

oracle::Half receivers_at_lights(const oracle::Half& half, const std::vector<LightSpot>& spots, double sigmas,
                                 double metres) {
  if (spots.empty()) return scattered_receivers(half, spots);
  Receivers receivers(beside(half, region_of(half, spots)));
  size_t k = 0;
  for (Draws draws; !receivers.full(); k = (k + 1) % spots.size()) {
    const dvec3 p = spots[k].position + (sigmas * spots[k].sigma + metres) * draws.direction();
    const glm::vec3 diffuse = draws.color(), f0 = draws.color();
    receivers.add(p, seen_normal(receivers.view(p), draws), diffuse, f0, draws.ndf());
  }
  return receivers.take();
}

oracle::Half receivers_at_angles(const oracle::Half& half, const std::vector<LightSpot>& spots,
                                 double light_cosine, double view_cosine) {
  const Region r = region_of(half, spots);
  const dvec3 up = glm::normalize(dvec3(half.emitter.position) - r.centre);
  const double distance = 50 * r.radius;
  Receivers receivers(r.centre + distance * (up + 1.5 * dvec3(half.emitter.right)));
  for (Draws draws; !receivers.full();) {
    const dvec3 p = r.centre + distance * (up + 0.3 * draws.direction());
    const dvec3 view = receivers.view(p), to_light = glm::normalize(r.centre - p);
    // n = a·light + b·view + c·(light × view) with the two cosines.
    const double c = glm::dot(view, to_light), det = 1 - c * c;
    const double lc = light_cosine * (0.5 + draws.uniform()),
                 vc = view_cosine * (0.5 + 0.5 * draws.uniform());
    const double a = (lc - c * vc) / det, b = (vc - c * lc) / det;
    const dvec3 in_plane = a * to_light + b * view;
    const double rest = std::sqrt(std::max(1 - glm::dot(in_plane, in_plane), 0.0));
    const dvec3 n = in_plane + rest * glm::normalize(glm::cross(to_light, view));
    const glm::vec3 diffuse = draws.color(), f0 = draws.color();
    receivers.add(p, n, diffuse, f0, draws.ndf());
  }
  return receivers.take();
}

oracle::Half glossy_receivers(const oracle::Half& half, const std::vector<LightSpot>& spots, float ndf) {
  const Region r = region_of(half, spots);
  const double sharpness = ndf > 0 ? 2 / (double(ndf) * ndf) : -double(ndf);
  Receivers receivers(beside(half, r));
  for (Draws draws; !receivers.full();) {
    const auto t = static_cast<size_t>(draws.uniform() * static_cast<double>(half.texels.size()));
    const oracle::Texel& texel = half.texels[t];
    const dvec3 n = glm::normalize(dvec3(texel.normal));
    const dvec3 in = glm::normalize(dvec3(half.emitter.position) - dvec3(texel.position));
    const dvec3 mirror = 2 * glm::dot(in, n) * n - in;
    // Off by up to two widths of either lobe.
    const double own = texel.ndf > 0 ? 2 / (double(texel.ndf) * texel.ndf) : -double(texel.ndf);
    const dvec3 out = glm::normalize(mirror + 2 * draws.uniform() / std::sqrt(own) * draws.direction());
    const dvec3 p = dvec3(texel.position) + r.radius * (0.5 + draws.uniform()) * out;
    const dvec3 half_way = glm::normalize(receivers.view(p) - out);
    const glm::vec3 f0 = draws.color();
    receivers.add(p, half_way + draws.uniform() / std::sqrt(sharpness) * draws.direction(), glm::vec3(0.1f),
                  f0, ndf);
  }
  return receivers.take();
}

}  // namespace vsglbench
