#include "scene/colonnade_parts.h"

#include <cmath>
#include <numbers>

#include "scene/shapes.h"

namespace vsglbench {
namespace {

constexpr double kHalfOpening = 0.95;  // the arch's radius; abaci fill the rest of the bay
constexpr int kArchSegments = 24;

// `count` steps of an ellipse's arc about (r, y), from angle a to b in degrees (0 outwards, 90 up); the first
// point is left out where it is the profile's last already.
void add_arc(std::vector<glm::dvec2>* profile, const glm::dvec2& centre, const glm::dvec2& radii, double a,
             double b, int count) {
  for (int i = 0; i <= count; ++i) {
    const double angle = glm::radians(a + (b - a) * i / count);
    const glm::dvec2 p = centre + radii * glm::dvec2(std::cos(angle), std::sin(angle));
    if (!profile->empty() && glm::length(p - profile->back()) < 1e-9) continue;
    profile->push_back(p);
  }
}

void add_crease(std::vector<glm::dvec2>* profile) {
  const glm::dvec2 last = profile->back();
  profile->push_back(last);
}

glm::dvec2 arch_point(int i, double radius) {
  const double angle = std::numbers::pi * (1 - double(i) / kArchSegments);
  return {radius * std::cos(angle), kSpring + radius * std::sin(angle)};
}

// One face of the wall, at z = side * kWallThickness/2, outward normal (0,0,side).
void add_arch_face(double top, double side, Mesh* wall) {
  const double z = side * kWallThickness / 2, edge = kBayWidth / 2;
  const uint32_t first = static_cast<uint32_t>(wall->positions.size());
  const auto vertex = [&](double x, double y) {
    wall->add_vertex({x, y, z}, {0, 0, side}, glm::vec2(side * x / kTile, -y / kTile));
  };
  // Columns of quads between the arch, or the springing line beside it, and the top.
  const auto column = [&](double x, double low) {
    constexpr int kRows = 3;
    for (int j = 0; j <= kRows; ++j) vertex(x, low + (top - low) * j / kRows);
  };
  column(-edge, kSpring);
  for (int i = 0; i <= kArchSegments; ++i)
    column(arch_point(i, kHalfOpening).x, arch_point(i, kHalfOpening).y);
  column(edge, kSpring);
  for (uint32_t i = 0; i < kArchSegments + 2; ++i) {
    for (uint32_t j = 0; j < 3; ++j) {
      const uint32_t a = first + 4 * i + j, b = a + 4;
      const glm::uvec3 lower(a, b, b + 1), upper(a, b + 1, a + 1);
      for (const glm::uvec3& t : {lower, upper}) {
        wall->triangles.push_back(side > 0 ? t : glm::uvec3(t.x, t.z, t.y));
      }
    }
  }
}

// The arch's underside, facing its centre, and the two undersides beside it.
void add_soffit(Mesh* stone) {
  const double z = kWallThickness / 2;
  const uint32_t first = static_cast<uint32_t>(stone->positions.size());
  for (int i = 0; i <= kArchSegments; ++i) {
    const glm::dvec2 p = arch_point(i, kHalfOpening);
    const glm::vec3 normal(-p.x / kHalfOpening, -(p.y - kSpring) / kHalfOpening, 0);
    const double s = std::numbers::pi * kHalfOpening * i / kArchSegments / kTile;
    stone->add_vertex({p.x, p.y, z}, normal, glm::vec2(s, 0));
    stone->add_vertex({p.x, p.y, -z}, normal, glm::vec2(s, -kWallThickness / kTile));
  }
  for (uint32_t i = 0; i < kArchSegments; ++i) {
    const uint32_t a = first + 2 * i;
    stone->triangles.emplace_back(a, a + 1, a + 3);
    stone->triangles.emplace_back(a, a + 3, a + 2);
  }
  for (const double x : {-kBayWidth / 2, kHalfOpening}) {
    add_grid(stone, {x, kSpring, -z}, {kBayWidth / 2 - kHalfOpening, 0, 0}, {0, 0, 2 * z}, 1, 1, kTile);
  }
}

// A half-round moulding along the arch, on the face at z = side * kWallThickness/2.
void add_archivolt(double radius, double tube, double side, Mesh* stone) {
  constexpr int kTubeSegments = 4;
  const uint32_t first = static_cast<uint32_t>(stone->positions.size());
  for (int i = 0; i <= kArchSegments; ++i) {
    const glm::dvec2 centre = arch_point(i, radius);
    const glm::dvec2 outward = (centre - glm::dvec2(0, kSpring)) / radius;
    for (int k = 0; k <= kTubeSegments; ++k) {
      const double angle = std::numbers::pi * (double(k) / kTubeSegments);
      const glm::dvec3 n(outward * std::cos(angle), side * std::sin(angle));
      stone->add_vertex(
          glm::dvec3(centre, side * kWallThickness / 2) + tube * n, glm::vec3(n),
          glm::vec2(std::numbers::pi * radius * i / kArchSegments, angle * tube) / float(kTile));
    }
  }
  const uint32_t row = kTubeSegments + 1;
  for (uint32_t i = 0; i < kArchSegments; ++i) {
    for (uint32_t k = 0; k < kTubeSegments; ++k) {
      const uint32_t a = first + i * row + k, b = a + 1, c = a + row, d = c + 1;
      const glm::uvec3 t1(a, c, d), t2(a, d, b);
      for (const glm::uvec3& t : {t1, t2}) {
        stone->triangles.push_back(side < 0 ? t : glm::uvec3(t.x, t.z, t.y));
      }
    }
  }
}

}  // namespace

Mesh arcade_column(int segments) {
  constexpr double kPlinth = 0.15, kAbacus = 0.12, kHalfPlinth = 0.31, kHalfAbacus = 0.30;
  Mesh mesh;
  add_box(&mesh, {-kHalfPlinth, 0, -kHalfPlinth}, {kHalfPlinth, kPlinth, kHalfPlinth}, kTile);
  add_box(&mesh, {-kHalfAbacus, kSpring - kAbacus, -kHalfAbacus}, {kHalfAbacus, kSpring, kHalfAbacus}, kTile);

  std::vector<glm::dvec2> profile;
  add_arc(&profile, {0.25, 0.205}, {0.055, 0.055}, -90, 90, 8);  // lower torus
  add_crease(&profile);
  add_arc(&profile, {0.285, 0.295}, {0.045, 0.035}, 270, 90, 8);  // scotia, hollow
  add_crease(&profile);
  add_arc(&profile, {0.235, 0.36}, {0.03, 0.03}, -90, 90, 6);  // upper torus
  add_crease(&profile);
  constexpr int kShaftRows = 14;
  for (int i = 0; i <= kShaftRows; ++i) {  // shaft: 0.225 at the foot, 0.185 at the neck, swelling between
    const double t = double(i) / kShaftRows;
    profile.emplace_back(0.225 - 0.04 * t * t, 0.39 + t * (2.32 - 0.39));
  }
  add_crease(&profile);
  add_arc(&profile, {0.19, 2.335}, {0.025, 0.015}, -90, 90, 6);  // astragal
  add_crease(&profile);
  profile.emplace_back(0.185, 2.44);  // neck
  add_crease(&profile);
  add_arc(&profile, {0.185, 2.58}, {0.105, 0.14}, -90, 0, 8);  // echinus
  add_lathe(&mesh, glm::dvec3(0), profile, segments, kTile);
  return mesh;
}

void add_arch(double top, Mesh* wall, Mesh* stone) {
  for (const double side : {-1.0, 1.0}) {
    add_arch_face(top, side, wall);
    add_archivolt(kHalfOpening + 0.07, 0.035, side, stone);
    add_archivolt(kHalfOpening + 0.19, 0.02, side, stone);
  }
  add_soffit(stone);
}

void add_balustrade(Mesh* stone) {
  constexpr int kBalusters = 8, kSegments = 8;
  const double half = kBayWidth / 2 - 0.2;  // into the columns' shafts
  add_box(stone, {-half, 0, -0.1}, {half, 0.1, 0.1}, kTile);
  add_box(stone, {-half, 0.88, -0.11}, {half, 1.0, 0.11}, kTile);
  std::vector<glm::dvec2> profile;
  add_arc(&profile, {0.05, 0.13}, {0.03, 0.03}, -90, 90, 4);
  add_crease(&profile);
  profile.emplace_back(0.035, 0.2);
  add_arc(&profile, {0.03, 0.38}, {0.05, 0.18}, -85, 85, 8);  // belly
  profile.emplace_back(0.03, 0.7);
  add_crease(&profile);
  add_arc(&profile, {0.045, 0.79}, {0.03, 0.09}, -90, 90, 4);
  const double step = 2 * (kBayWidth / 2 - 0.3) / kBalusters;
  for (int i = 0; i < kBalusters; ++i) {
    add_lathe(stone, {-kBayWidth / 2 + 0.3 + (i + 0.5) * step, 0, 0}, profile, kSegments, kTile);
  }
}

Mesh arch_cloth(int cells, int seed) {
  constexpr double kLow = 0.9, kHigh = 3.0, kHalfWidth = 0.92;
  Mesh mesh;
  const double folds = 4 + seed % 3, phase = 1.7 * seed;
  const auto position = [&](double s, double t) {
    // Folds deepen towards the hem, which sags in the middle.
    const double x = kHalfWidth * (2 * s - 1);
    const double depth = 0.02 + 0.09 * (1 - t);
    const double z = depth * std::sin(2 * std::numbers::pi * folds * s + phase + 0.8 * (1 - t));
    return glm::dvec3(x, kLow + (kHigh - kLow) * t - 0.12 * (1 - t) * std::sin(std::numbers::pi * s), z);
  };
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const double s = double(i) / cells, t = double(j) / cells, h = 1e-4;
      const glm::dvec3 du = position(s + h, t) - position(s - h, t),
                       dv = position(s, t + h) - position(s, t - h);
      mesh.add_vertex(position(s, t), glm::vec3(glm::normalize(glm::cross(du, dv))),
                      glm::vec2(2 * kHalfWidth * s, -(kHigh - kLow) * t) / float(kTile));
    }
  }
  const uint32_t row = static_cast<uint32_t>(cells) + 1;
  for (uint32_t j = 0; j + 1 < row; ++j) {
    for (uint32_t i = 0; i + 1 < row; ++i) {
      const uint32_t a = j * row + i, b = a + 1, c = a + row, d = c + 1;
      mesh.triangles.emplace_back(a, b, d);
      mesh.triangles.emplace_back(a, d, c);
    }
  }
  add_box(&mesh, {-1, kHigh, -0.02}, {1, kHigh + 0.04, 0.02}, kTile);  // the rod it hangs from
  return mesh;
}

}  // namespace vsglbench
