// The stability suite on the methods that come with the programme, and on faults planted in their shaders. By
// itself: it starts processes, which a program that holds a device can't.
#include "stability/stability.h"

#include <gtest/gtest.h>

#include <stdlib.h>

#include <cmath>
#include <set>

#include "stability/planted_tree.h"

using namespace vsglbench;

namespace {

std::vector<StabilityCell> tried(const StabilityOptions& options) {
  return run_stability(options, [](const StabilityCell&) {});
}

std::string line(const StabilityCell& c) {
  return fmt::format("{} {} {} {} {:.2e} {}", stability_name(c.status), c.hard_case, c.method, c.diffuse,
                     c.error, c.why);
}

// The one cell of a case and a method.
StabilityCell cell_of(const StabilityOptions& options) {
  const auto cells = tried(options);
  EXPECT_EQ(cells.size(), 1u);
  return cells.empty() ? StabilityCell{} : cells.front();
}
StabilityCell cell_of(const std::string& hard_case, const std::string& method) {
  return cell_of({.methods = {method}, .cases = {hard_case}, .diffuse = {"cosine"}});
}

}  // namespace

TEST(Stability, NoCellIsBad) {
  std::set<std::pair<std::string, std::string>> seen;
  for (const StabilityCell& cell : tried({})) {
    EXPECT_NE(cell.status, Stability::bad) << line(cell);
    EXPECT_FALSE(cell.why.empty()) << line(cell);
    EXPECT_TRUE(cell.status != Stability::ok || cell.error <= kOkError) << line(cell);
    seen.emplace(cell.hard_case, cell.method);
  }
  for (const StabilityRow& row : stability_rows({})) {
    for (const std::string& name : stability_cases()) {
      EXPECT_TRUE(seen.contains({name, row.name})) << name << " " << row.name;
    }
  }
}

// Whether the device may fuse and regroup arithmetic anywhere, or nowhere.
TEST(Stability, NoCellIsBadWhateverIsContracted) {
  for (const char* contraction : {"never", "always"}) {
    ::setenv("VSGLBENCH_CONTRACTION", contraction, 1);
    const auto cells = tried({.methods = {"mfis", "kmeans2d-segmented", "vpl"}});
    ::unsetenv("VSGLBENCH_CONTRACTION");
    for (const StabilityCell& cell : cells)
      EXPECT_NE(cell.status, Stability::bad) << contraction << line(cell);
  }
}

TEST(Stability, CellsSurviveJson) {
  for (const double error : {0.25, static_cast<double>(INFINITY)}) {
    const StabilityCell cell{"a", "b", "c", Stability::bias, error, "light 1", "why"};
    const StabilityCell back = cell_from_json(Json::parse(to_json(cell).dump()));
    EXPECT_EQ(line(back), line(cell));
    EXPECT_EQ(back.where, cell.where);
  }
}

TEST(Stability, UnknownNamesAreRefused) {
  EXPECT_THROW(tried({.cases = {"gentl"}}), Error);
  EXPECT_THROW(tried({.methods = {"vpll"}}), Error);
  EXPECT_THROW(tried({.diffuse = {"cosin"}}), Error);
}

TEST(Verdicts, FollowTheWorstFigure) {
  Judgement verdict;
  verdict.error(5e-4, "light 1", "power");
  EXPECT_EQ(verdict.cell("", "", "").status, Stability::ok);
  verdict.error(2e-3, "pixel (1,0)");
  verdict.error(1e-3, "pixel (2,0)");
  EXPECT_EQ(verdict.cell("", "", "").status, Stability::bias);
  EXPECT_EQ(verdict.cell("", "", "").where, "pixel (1,0)");
  verdict.error(std::nan(""), "pixel (3,0)");
  EXPECT_EQ(verdict.cell("", "", "").status, Stability::bad);
  EXPECT_EQ(verdict.cell("", "", "").error, INFINITY);
}

// λ-λ1-λ2 has no digits left where the light is a point or the lobes are sharp.
TEST(PlantedFaults, TheNaiveProductIsBad) {
  ASSERT_EQ(cell_of("one-texel-clusters", "mfis").status, Stability::ok);
  const PlantedTree tree;
  tree.plant("shaders", "sg.glsl");
  for (const char* method : {"mfis", "kmeans2d-segmented"}) {
    for (const char* hard_case : {"one-texel-clusters", "sharpness"}) {
      EXPECT_EQ(cell_of(hard_case, method).status, Stability::bad) << line(cell_of(hard_case, method));
    }
  }
  EXPECT_EQ(cell_of("gentle", "vpl").status, Stability::ok);  // which has no product
}

// E|y|²-|μ|² about the origin.
TEST(PlantedFaults, TheNaiveVarianceIsBad) {
  const PlantedTree tree;
  tree.plant("shaders", "moments.glsl");
  tree.plant("method/shaders", "cluster_sum.glsl");
  for (const char* method : {"fis", "mfis", "kmeans2d", "kmeans3d-segmented"}) {
    EXPECT_EQ(cell_of("far-half", method).status, Stability::bad) << line(cell_of("far-half", method));
  }
  // Near the origin it does: it is the distance that it can't bear.
  EXPECT_EQ(cell_of("gentle", "mfis").status, Stability::ok) << line(cell_of("gentle", "mfis"));
}

// 1-(n·h)² by the dot product.
TEST(PlantedFaults, TheNaiveNormalDistributionIsBad) {
  const PlantedTree tree;
  tree.plant("shaders", "brdf.glsl");
  for (const char* hard_case : {"mirror-half", "phong-1e7"}) {
    EXPECT_EQ(cell_of(hard_case, "vpl").status, Stability::bad) << line(cell_of(hard_case, "vpl"));
  }
  EXPECT_EQ(cell_of("gentle", "vpl").status, Stability::ok);
}
