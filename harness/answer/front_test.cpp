#include "answer/front.h"

#include <gtest/gtest.h>

#include "answer/made_report.h"

namespace vsglbench {
namespace {

MadeCase at(double ms, double error, const std::string& method = "fis", int n = 0) {
  return {.method = method,
          .parameters = {{"N", n}, {"visibility", "none"}},
          .passes = {{"shade", ms}},
          .error = error};
}

PointGroup group_of(const Report& report) {
  auto groups = point_groups(report);
  EXPECT_EQ(groups.size(), 1u);
  return groups.at(0);
}

// The definition: nobody has less of one and no more of the other.
std::set<std::string> front_by_definition(const PointGroup& g) {
  std::set<std::string> out;
  for (const Point& p : g.points) {
    bool beaten = false;
    for (const Point& q : g.points) {
      beaten |= q.ms.value <= p.ms.value && q.error.value <= p.error.value &&
                (q.ms.value < p.ms.value || q.error.value < p.error.value);
    }
    if (!beaten) out.insert(p.result->id);
  }
  return out;
}

TEST(Front, IsWhatTheDefinitionSays) {
  MadeReport made(1, 0, 0);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<> value(1, 100);
  for (int i = 0; i < 300; ++i) made.add(at(value(random), value(random), "fis", i));
  const PointGroup g = group_of(made.report);
  std::set<std::string> front;
  for (const size_t i : front_of(g)) front.insert(g.points[i].result->id);
  EXPECT_EQ(front, front_by_definition(g));
  EXPECT_GT(front.size(), 3u);
}

TEST(Front, EveryOtherPointIsDominatedOrAmbiguous) {
  MadeReport made(2, 0.01, 0.05);
  made.add(at(10, 10, "cut"));
  made.add(at(20, 20, "slow-and-wrong"));
  made.add(at(10.02, 10.001, "like-cut"));
  made.add(at(20, 10, "slow"));  // the same errors seed by seed, so that only time tells
  const PointGroup g = group_of(made.report);
  std::map<std::string, Standing> standing;
  std::map<std::string, std::vector<size_t>> by;
  for (const Placed& p : place(g)) {
    standing[g.points[p.point].result->method] = p.standing;
    by[g.points[p.point].result->method] = p.by;
  }
  const std::string best = g.points[front_of(g).front()].result->method;
  EXPECT_TRUE(best == "cut" || best == "like-cut");
  EXPECT_EQ(standing["slow-and-wrong"], Standing::dominated);
  EXPECT_EQ(standing["slow"], Standing::dominated);
  EXPECT_NE(standing[best == "cut" ? "like-cut" : "cut"], Standing::dominated);
  EXPECT_FALSE(by["slow"].empty());
}

// Without the pairing of seeds the two errors' intervals overlap widely.
TEST(Front, PairedSeedsTellApartWhatIntervalsDoNot) {
  MadeReport made(3, 0.001, 0.3);
  made.add(at(10, 10, "a"));
  made.add(at(10, 11, "b"));
  const PointGroup g = group_of(made.report);
  const Point &a = g.points[g.points[0].result->method == "a" ? 0 : 1],
              &b = g.points[&a == &g.points[0] ? 1 : 0];
  EXPECT_LT(b.error.ci95.lo, a.error.ci95.hi);
  EXPECT_EQ(compare_errors(a, b), Relation::better);
  EXPECT_EQ(compare_errors(b, a), Relation::worse);
  EXPECT_EQ(compare_errors(a, a), Relation::same);
}

TEST(Front, NoiseOfTheMachineMakesTimesTheSame) {
  MadeReport made(4, 0.0005, 0);
  made.add(at(10, 10, "a"));
  made.add(at(10.5, 10, "b"));
  PointGroup g = group_of(made.report);
  EXPECT_EQ(compare_costs(g.points[0], g.points[1], 0), Relation::better);
  EXPECT_EQ(compare_costs(g.points[0], g.points[1], 0.1), Relation::same);
}

// error = 100 / ms: between any two points the line in log-log is that curve.
TEST(Front, InterpolatesInLogLogAndNeverExtrapolates) {
  MadeReport made(5, 0, 0);
  int n = 0;
  for (const double ms : {1.0, 4.0, 32.0}) made.add(at(ms, 100 / ms, "fis", ++n));
  const PointGroup g = group_of(made.report);
  const auto front = front_of(g);
  for (const double ms : {1.0, 1.7, 4.0, 20.0, 32.0}) {
    EXPECT_NEAR(error_at(g, front, ms).value(), 100 / ms, 1e-9 * 100 / ms);
    EXPECT_NEAR(time_to_reach(g, front, 100 / ms).value(), ms, 1e-9 * ms);
  }
  EXPECT_FALSE(error_at(g, front, 0.99));
  EXPECT_FALSE(error_at(g, front, 32.1));
  EXPECT_FALSE(time_to_reach(g, front, 100.1));
  EXPECT_FALSE(time_to_reach(g, front, 3.1));
}

// An error without occlusion is against another reference than one with it.
TEST(Front, PointsOfTwoReferencesShareNoFront) {
  MadeReport made(6, 0, 0);
  made.add(at(1, 1));
  MadeCase seen = at(2, 2);
  seen.parameters["visibility"] = "exact";
  seen.reference = "4567";
  made.add(seen);
  const auto groups = point_groups(made.report);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].visibility, "none");
  EXPECT_EQ(groups[1].visibility, "full");
}

TEST(Front, RasterOfTheHalvesIsNoCostOfAMethod) {
  MadeReport made(7, 0, 0);
  made.add({.passes = {{"gbuffer", 100}, {"rsm", 50}, {"shade", 3}}});
  EXPECT_DOUBLE_EQ(group_of(made.report).points[0].ms.value, 3);
  EXPECT_DOUBLE_EQ(point_groups(made.report, {"smape", "frame"})[0].points[0].ms.value, 153);
  EXPECT_THROW(point_groups(made.report, {"smap", "method"}), Error);
  EXPECT_THROW(point_groups(made.report, {"bias", "method"}), Error);
  EXPECT_THROW(point_groups(made.report, {"smape", "methods"}), Error);
}

}  // namespace
}  // namespace vsglbench
