#include "scene/track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace vsglbench {
namespace {

using glm::dquat;
using glm::dvec3;

template <class T>
Track<T> track(Interpolation interpolation, const std::vector<double>& times, const std::vector<T>& values) {
  Track<T> t;
  t.interpolation = interpolation;
  t.times = times;
  t.values = values;
  return t;
}

dquat about_y(double degrees) {
  const double half = degrees * std::numbers::pi / 360;
  return {std::cos(half), 0, std::sin(half), 0};
}

void expect_near(const dquat& a, const dquat& b, double tolerance = 1e-12) {
  EXPECT_LT(glm::length(a - b), tolerance) << a.w << " " << a.x << " " << a.y << " " << a.z;
}

TEST(Track, HoldsBeforeTheFirstKeyAndAfterTheLast) {
  for (const auto mode : {Interpolation::step, Interpolation::linear}) {
    const auto t = track<double>(mode, {1, 2, 4}, {10, 20, 0});
    EXPECT_EQ(t.at(-5), 10);
    EXPECT_EQ(t.at(1), 10);
    EXPECT_EQ(t.at(2), 20);
    EXPECT_EQ(t.at(4), 0);
    EXPECT_EQ(t.at(99), 0);
  }
  EXPECT_EQ(Track<double>(7).at(3), 7);
}

TEST(Track, StepKeepsEachKeyUntilTheNext) {
  const auto t = track<double>(Interpolation::step, {0, 1, 2}, {5, 6, 7});
  EXPECT_EQ(t.at(0.999), 5);
  EXPECT_EQ(t.at(1), 6);
  EXPECT_EQ(t.at(1.999), 6);
}

TEST(Track, LinearIsStraight) {
  const auto t = track<dvec3>(Interpolation::linear, {1, 3}, {{0, 0, 0}, {4, -8, 2}});
  const dvec3 v = t.at(1.5);
  EXPECT_NEAR(v.x, 1, 1e-15);
  EXPECT_NEAR(v.y, -2, 1e-15);
  EXPECT_NEAR(v.z, 0.5, 1e-15);
}

// A third of the way from 0 to 90 degrees is 30 degrees, whatever the keys' lengths and signs.
TEST(Track, RotationsAreSphericalAlongTheShorterArc) {
  for (const double factor : {1.0, -1.0, 3.0, -0.25}) {
    const auto t = track<dquat>(Interpolation::linear, {0, 3}, {about_y(0), about_y(90) * factor});
    expect_near(t.at(1), about_y(30));
    EXPECT_NEAR(glm::length(t.at(2.2)), 1, 1e-15);
  }
  // 10 and 350 degrees are 20 apart, by way of 0.
  const auto t = track<dquat>(Interpolation::linear, {0, 1}, {about_y(10), about_y(350)});
  expect_near(t.at(0.5), about_y(0));
  // Keys so near that their cosine rounds to 1.
  const auto near = track<dquat>(Interpolation::linear, {0, 1}, {about_y(0), about_y(1e-7)});
  EXPECT_NEAR(near.at(0.25).y / near.at(1).y, 0.25, 1e-9);
}

// glTF 2.0, Appendix C.5, as it stands there.
template <class T>
T cubic_of_the_specification(const Track<T>& track, size_t k, double time) {
  const double td = track.times[k + 1] - track.times[k], t = (time - track.times[k]) / td;
  const double t2 = t * t, t3 = t2 * t;
  return track.values[k] * (2 * t3 - 3 * t2 + 1) + track.out[k] * (td * (t3 - 2 * t2 + t)) +
         track.values[k + 1] * (-2 * t3 + 3 * t2) + track.in[k + 1] * (td * (t3 - t2));
}

TEST(Track, CubicIsThatOfTheSpecification) {
  auto t = track<dvec3>(Interpolation::cubic, {0.5, 2, 2.25}, {{1, 2, 3}, {-1, 5, 0}, {0, 0, 7}});
  t.in = {{9, 9, 9}, {1, 0, -2}, {0.5, 1, 1}};
  t.out = {{2, -1, 0}, {-3, 1, 4}, {9, 9, 9}};
  auto q = track<dquat>(Interpolation::cubic, {0, 2}, {about_y(20), about_y(100)});
  q.in = q.out = {dquat(0.1, 0.2, -0.3, 0.05), dquat(-0.2, 0, 0.1, 0.4)};
  for (double u = 0; u < 1; u += 0.0625) {
    for (size_t k = 0; k < 2; ++k) {
      const double time = t.times[k] + u * (t.times[k + 1] - t.times[k]);
      EXPECT_LT(glm::length(t.at(time) - cubic_of_the_specification(t, k, time)), 1e-14) << k << " " << u;
    }
    expect_near(q.at(2 * u), glm::normalize(cubic_of_the_specification(q, 0, 2 * u)), 1e-14);
  }
}

TEST(Track, SmoothPassesThroughItsKeysWithoutACorner) {
  auto t = track<double>(Interpolation::linear, {0, 1, 3, 4}, {0, 2, -1, 5});
  smooth(&t);
  EXPECT_EQ(t.interpolation, Interpolation::cubic);
  const double h = 1e-6, slope_at_1 = (-1.0 - 0.0) / 3, slope_at_3 = (5.0 - 2.0) / 3;
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(t.at(t.times[i]), t.values[i]);
  EXPECT_NEAR((t.at(1 + h) - t.at(1)) / h, slope_at_1, 1e-4);
  EXPECT_NEAR((t.at(1) - t.at(1 - h)) / h, slope_at_1, 1e-4);
  EXPECT_NEAR((t.at(3 + h) - t.at(3 - h)) / (2 * h), slope_at_3, 1e-4);
  EXPECT_NEAR((t.at(h) - t.at(0)) / h, 2, 1e-4);  // at the end: to its one neighbour
  // Even steps along a line stay a line.
  auto line = track<dvec3>(Interpolation::linear, {0, 1, 2}, {{0, 0, 0}, {1, 2, 3}, {2, 4, 6}});
  smooth(&line);
  EXPECT_LT(glm::length(line.at(1.3) - dvec3(1.3, 2.6, 3.9)), 1e-14);
}

TEST(Track, SmoothTurnsQuaternionsToTheNearerSign) {
  auto a = track<dquat>(Interpolation::linear, {0, 1, 2}, {about_y(0), about_y(30), about_y(60)});
  auto b = a;
  b.values[1] = -b.values[1];
  smooth(&a), smooth(&b);
  for (double time = 0; time < 2; time += 0.1) expect_near(a.at(time), b.at(time));
  expect_near(a.at(0.5), about_y(15), 2e-3);
}

template <class T>
void expect_same_bits(const Track<T>& track) {
  const T rest = track.at(0);
  for (double time = -1; time < 4; time += 0.0371) {
    const T v = track.at(time);
    EXPECT_TRUE(v == rest) << time;
  }
}

// What rests between keys rests to the bit, so that a frame in which nothing moves is told from one in which
// something does.
TEST(Track, EqualKeysAreExactlyTheirValue) {
  const dvec3 v(0.1, 1.0 / 3, -7.77);
  const dquat q = dquat(0.3, 0.7, -0.2, 0.1) * 1.7;
  for (const auto mode : {Interpolation::step, Interpolation::linear}) {
    expect_same_bits(track<dvec3>(mode, {0, 0.7, 3}, {v, v, v}));
    expect_same_bits(track<dquat>(mode, {0, 0.7, 3}, {q, q, q}));
  }
  auto vectors = track<dvec3>(Interpolation::linear, {0, 0.7, 3}, {v, v, v});
  auto rotations = track<dquat>(Interpolation::linear, {0, 0.7, 3}, {q, q, q});
  smooth(&vectors), smooth(&rotations);
  expect_same_bits(vectors);
  expect_same_bits(rotations);
}

TEST(Track, ProblemsAreTold) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto linear = Interpolation::linear;
  EXPECT_EQ(problem_of(Track<double>(1)), "");
  EXPECT_EQ(problem_of(track<double>(linear, {0, 1}, {1, 2})), "");
  EXPECT_NE(problem_of(Track<double>()), "");
  EXPECT_NE(problem_of(track<double>(linear, {0, 1}, {1})), "");
  EXPECT_NE(problem_of(track<double>(linear, {0, 0}, {1, 2})), "");
  EXPECT_NE(problem_of(track<double>(linear, {1, 0}, {1, 2})), "");
  EXPECT_NE(problem_of(track<double>(linear, {0, nan}, {1, 2})), "");
  EXPECT_NE(problem_of(track<double>(linear, {0, 1}, {1, nan})), "");
  EXPECT_NE(problem_of(track<dquat>(linear, {0}, {dquat(0, 0, 0, 0)})), "");
  EXPECT_NE(problem_of(track<double>(Interpolation::cubic, {0, 1}, {1, 2})), "");
  auto cubic = track<double>(Interpolation::cubic, {0, 1}, {1, 2});
  cubic.in = cubic.out = {0, nan};
  EXPECT_NE(problem_of(cubic), "");
}

}  // namespace
}  // namespace vsglbench
