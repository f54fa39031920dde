#include "lights/edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "method/made_half.h"

namespace vsglbench {
namespace {

using glm::dvec3;

// From the emitter through a place on its plane, in texels from the upper left corner.
dvec3 direction(const gpu::Emitter& e, double x, double y) {
  return dvec3(e.forward) + (2 * x / e.width - 1) * e.extent.x * dvec3(e.right) +
         (1 - 2 * y / e.height) * e.extent.y * dvec3(e.up);
}

// What a texel shows: where the plane of this normal through `through` is met.
struct Plane {
  dvec3 normal, through;
  dvec3 meet(const gpu::Emitter& e, double x, double y) const {
    const dvec3 from(e.position), along = direction(e, x, y);
    return from + along * (glm::dot(through - from, normal) / glm::dot(along, normal));
  }
};

template <class PlaneOf>
TexelSurfaces seen(const gpu::Emitter& e, const PlaneOf& plane_of) {
  std::vector<glm::vec4> positions, normals;
  for (uint32_t y = 0; y < e.height; ++y) {
    for (uint32_t x = 0; x < e.width; ++x) {
      const Plane plane = plane_of(x, y);
      positions.emplace_back(plane.meet(e, x + 0.5, y + 0.5), 1);
      normals.emplace_back(plane.normal, 0);
    }
  }
  return surfaces_of(e, positions, normals);
}

const Plane kFloor{{0, 1, 0}, {0, 0, 0}};
const Plane kSlope{glm::normalize(dvec3(0.7, 1, -0.4)), {0, 0.5, 0}};

// On planes, from the rays through a texel's corners: half the cross product of its diagonals.
// What is left is how the plane recedes within a texel.
TEST(Edges, ATexelsSizeIsTheSideOfItsSquareOnTheSurface) {
  gpu::Emitter e = spot(40, 24);
  for (const uint32_t perspective : {1u, 0u}) {
    e.perspective = perspective;
    for (const Plane& plane : {kFloor, kSlope}) {
      std::vector<glm::vec4> positions, normals(size_t(e.width) * e.height, glm::vec4(plane.normal, 0));
      std::vector<double> areas;
      for (uint32_t y = 0; y < e.height; ++y) {
        for (uint32_t x = 0; x < e.width; ++x) {
          const auto at = [&](double px, double py) {
            if (e.perspective) return plane.meet(e, px, py);
            const dvec3 from = dvec3(e.position) + direction(e, px, py) - dvec3(e.forward);
            const dvec3 along(e.forward);
            return from +
                   along * (glm::dot(plane.through - from, plane.normal) / glm::dot(along, plane.normal));
          };
          positions.emplace_back(at(x + 0.5, y + 0.5), 1);
          areas.push_back(0.5 *
                          glm::length(glm::cross(at(x + 1, y + 1) - at(x, y), at(x + 1, y) - at(x, y + 1))));
        }
      }
      const TexelSurfaces half = surfaces_of(e, positions, normals);
      for (size_t i = 0; i < areas.size(); ++i)
        EXPECT_NEAR(half.sizes[i] / std::sqrt(areas[i]), 1, 3e-3) << i;
    }
  }
}

TEST(Edges, APlaneHasNone) {
  const gpu::Emitter e = spot(61, 35);
  for (const Plane& plane : {kFloor, kSlope}) {
    const TexelSurfaces half = seen(e, [&](auto, auto) { return plane; });
    for (const FootprintEdges& f : footprint_edges(half, {{30.5f, 17.5f, 200, 0}, {3.5f, 33.5f, 5, 0}})) {
      EXPECT_EQ(f.share, 0);
      EXPECT_GT(f.texel, 0);
    }
  }
}

// A texel of the floor is 1.4 · 4 m/64 = 87.5 mm wide and 4 m/64 = 62.5 mm high: as large as a square of 74
// mm.
TEST(Edges, AStepOfMoreThanTwoTexelsIsOne) {
  const gpu::Emitter e = spot(64, 64);
  const auto with_step = [&](double height) {
    return seen(e, [&](uint32_t x, uint32_t) { return x < 32 ? kFloor : Plane{{0, 1, 0}, {0, height, 0}}; });
  };
  // 4 × 4 texels over the step: 4 of 12 pairs in rows, none of 12 in columns; beside it none.
  const std::vector<glm::vec4> squares = {{32, 20, 4, 0}, {30, 20, 4, 0}, {34, 20, 4, 0}};
  const auto high = footprint_edges(with_step(0.155), squares),
             low = footprint_edges(with_step(0.14), squares);
  EXPECT_DOUBLE_EQ(high[0].share, 4.0 / 24);
  EXPECT_EQ(high[1].share, 0);
  EXPECT_EQ(high[2].share, 0);
  EXPECT_EQ(low[0].share, 0);
  EXPECT_NEAR(high[1].texel, std::sqrt(1.4 * 4 / 64 * 4.0 / 64), 1e-6);
}

// The roof of a box: two planes that meet have an edge where they are more than 60° apart.
TEST(Edges, WherePlanesMeetTheAngleTells) {
  const gpu::Emitter e = spot(64, 64);
  const auto ridge = [&](double degrees) {
    const double half_angle = degrees / 2 / 180 * std::numbers::pi;
    const dvec3 through(e.position.x, 1, 0);
    return seen(e, [&](uint32_t x, uint32_t) {
      const double side = x < 32 ? -1 : 1;
      return Plane{{side * std::sin(half_angle), std::cos(half_angle), 0}, through};
    });
  };
  const std::vector<glm::vec4> square = {{32, 20, 4, 0}};
  EXPECT_EQ(footprint_edges(ridge(59), square)[0].share, 0);
  EXPECT_DOUBLE_EQ(footprint_edges(ridge(61), square)[0].share, 4.0 / 24);
}

// Of single texels, of a hole, and of nothing.
TEST(Edges, AHolesRimIsOneAndNothingHasNone) {
  const gpu::Emitter e = spot(8, 8);
  TexelSurfaces half = seen(e, [&](auto, auto) { return kFloor; });
  for (const size_t hole : {size_t(2 * 8 + 2), size_t(2 * 8 + 3)}) {
    half.positions[hole] = glm::vec4(0);
    half.sizes[hole] = 0;
  }
  const auto f = footprint_edges(
      half, {{3, 3, 6, 0}, {2.5f, 2.5f, 1, 0}, {3, 2.5f, 1, 0}, {5.5f, 5.5f, 1, 0}, {4, 4, 0, 0}});
  // 6 × 6 texels: 30 pairs in rows and columns each, of which one has no surface; 2 and 4 are at the rim.
  EXPECT_DOUBLE_EQ(f[0].share, 6.0 / 59);
  EXPECT_EQ(f[1].share, 0);
  EXPECT_EQ(f[1].texel, 0) << "no surface";
  EXPECT_EQ(f[2].share, 0);
  EXPECT_EQ(f[3].share, 0) << "one texel has no neighbour under the square";
  EXPECT_GT(f[3].texel, 0);
  EXPECT_EQ(f[4].texel, 0) << "no light";
}

// Pair by pair, from the definition.
FootprintEdges by_hand(const TexelSurfaces& half, const glm::vec4& square) {
  std::vector<std::pair<uint32_t, uint32_t>> under;
  for (uint32_t y = 0; y < half.height; ++y) {
    for (uint32_t x = 0; x < half.width; ++x) {
      const double left = std::max<double>(x, double(square.x) - 0.5 * square.z),
                   right = std::min<double>(x + 1.0, double(square.x) + 0.5 * square.z),
                   above = std::max<double>(y, double(square.y) - 0.5 * square.z),
                   below = std::min<double>(y + 1.0, double(square.y) + 0.5 * square.z);
      if (left < right && above < below) under.emplace_back(x, y);
    }
  }
  double pairs = 0, edges = 0;
  std::vector<double> sizes;
  for (const auto& [ax, ay] : under) {
    const size_t a = size_t(ay) * half.width + ax;
    if (half.positions[a].w > 0) sizes.push_back(half.sizes[a]);
    for (const auto& [bx, by] : under) {
      if (!((bx == ax + 1 && by == ay) || (bx == ax && by == ay + 1))) continue;
      const size_t b = size_t(by) * half.width + bx;
      const int surfaces = (half.positions[a].w > 0) + (half.positions[b].w > 0);
      if (surfaces == 0) continue;
      ++pairs;
      if (surfaces == 1) {
        ++edges;
        continue;
      }
      const dvec3 na(half.normals[a]), nb(half.normals[b]), pa(half.positions[a]), pb(half.positions[b]);
      const double two_texels = 2 * std::max(half.sizes[a], half.sizes[b]);
      if (glm::dot(na, nb) < std::cos(std::numbers::pi / 3) ||
          std::abs(glm::dot(pb, na) - glm::dot(pa, na)) > two_texels ||
          std::abs(glm::dot(pb, nb) - glm::dot(pa, nb)) > two_texels)
        ++edges;
    }
  }
  std::sort(sizes.begin(), sizes.end());
  const size_t n = sizes.size();
  const double middle = n == 0 ? 0 : 0.5 * (sizes[(n - 1) / 2] + sizes[n / 2]);
  return {pairs > 0 ? edges / pairs : 0, middle};
}

TEST(Edges, AgreesWithAllPairsOneByOne) {
  constexpr uint32_t kWidth = 37, kHeight = 23;
  const oracle::Half made = random_half(kWidth, kHeight, 5);
  std::vector<glm::vec4> positions, normals;
  for (const oracle::Texel& t : made.texels) {
    positions.emplace_back(t.position, t.surface ? 1 : 0);
    normals.emplace_back(t.geometric_normal, 0);
  }
  const TexelSurfaces half = surfaces_of(made.emitter, positions, normals);
  std::mt19937 random(1);
  const auto uniform = [&](double most) { return static_cast<float>(most * (random() >> 8) * 0x1p-24); };
  std::vector<glm::vec4> squares;
  for (int i = 0; i < 200; ++i)  // some reach outside of the half
    squares.emplace_back(std::floor(uniform(kWidth)) + 0.5f, std::floor(uniform(kHeight)) + 0.5f,
                         std::exp2(uniform(5.5)), 0);
  const auto found = footprint_edges(half, squares);
  double least = 1, most = 0;
  for (size_t i = 0; i < squares.size(); ++i) {
    const FootprintEdges f = by_hand(half, squares[i]);
    EXPECT_NEAR(found[i].share, f.share, 1e-12) << i;
    EXPECT_NEAR(found[i].texel, f.texel, 1e-12) << i;
    least = std::min(least, f.share);
    most = std::max(most, f.share);
  }
  EXPECT_LT(least, 0.3);
  EXPECT_GT(most, 0.7);
}

// Lights of σ and power under squares of 4 texels of 0.1 m.
struct Made {
  std::vector<gpu::Vsgl> lights;
  std::vector<glm::vec4> squares;
  std::vector<FootprintEdges> edges;
  void add(float sigma, float power, double share, float side = 4) {
    gpu::Vsgl l{};
    l.variance = sigma * sigma;
    l.power = power;
    lights.push_back(l);
    squares.emplace_back(0, 0, side, 0);
    edges.push_back({share, 0.1});
  }
  EdgeEffect effect() const { return edge_effect(records_of(LightKind::vsgl, lights), squares, edges); }
};

TEST(Edges, LargerAndDarkerIsTwoRatios) {
  Made made;
  for (int i = -5; i <= 5; ++i) {
    made.add(0.3f + 0.01f * static_cast<float>(i), 1, 0.05);   // on the bound is off
    made.add(0.6f + 0.01f * static_cast<float>(i), 2, 0.051);  // twice as large
  }
  const EdgeEffect effect = made.effect();
  EXPECT_EQ(effect.on, 11u);
  EXPECT_EQ(effect.off, 11u);
  ASSERT_TRUE(effect.sigma && effect.density);
  EXPECT_NEAR(effect.sigma->value, 2, 1e-5);
  EXPECT_NEAR(effect.density->value, 2.0 / 4, 1e-5);
  EXPECT_LT(effect.sigma->ci95.lo, 2);
  EXPECT_GT(effect.sigma->ci95.hi, 2);
  EXPECT_GT(effect.sigma->ci95.lo, 0.55 / 0.35);
  EXPECT_LT(effect.sigma->ci95.hi, 0.65 / 0.25);
  EXPECT_EQ(made.effect().sigma->ci95.lo, effect.sigma->ci95.lo) << "the same every time";
}

// As large as their squares: no effect, whatever the squares are.
TEST(Edges, SigmaIsMeasuredInSquares) {
  Made made;
  for (int i = 0; i < 20; ++i) {
    made.add(0.3f, 1, 0);
    made.add(1.2f, 1, 0.5, 16);
  }
  EXPECT_NEAR(made.effect().sigma->value, 1, 1e-6);
  EXPECT_NEAR(made.effect().density->value, 1.0 / 16, 1e-6);
}

TEST(Edges, TooFewLightsHaveNoRatioAndSomeDoNotCount) {
  Made made;
  for (int i = 0; i < 8; ++i) {
    made.add(0.3f, 1, 0);
    if (i < 7) made.add(0.3f, 1, 0.5);
  }
  made.add(0.3f, 0, 0.5);        // no power
  made.add(0.3f, 1, 0.5, 1.9f);  // a single texel
  made.add(0.3f, 1, 0.5);
  made.edges.back().texel = 0;  // nothing under it
  EXPECT_EQ(made.effect().on, 7u);
  EXPECT_EQ(made.effect().off, 8u);
  EXPECT_FALSE(made.effect().sigma || made.effect().density);
  made.add(0.3f, 1, 0.5);
  EXPECT_TRUE(made.effect().sigma && made.effect().density);
}

}  // namespace
}  // namespace vsglbench
