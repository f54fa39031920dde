// Whether raster is slow, and that a table says so.
#include "report/raster.h"

#include <gtest/gtest.h>

#include "report/table_notes.h"

using namespace vsglbench;

namespace {

Report report(double drawn_ms, double computed_ms, uint64_t triangles = 514) {
  Report r;
  r.device = {.name = "made", .type = "discrete"};
  r.config = {{"frame", {{"width", 1920}, {"height", 1088}}}};
  SceneReport scene;
  scene.name = "ring";
  scene.triangles = triangles;
  r.scenes = {scene};
  CaseResult c;
  c.scene = "ring";
  c.passes.push_back({parse_pass_name("gbuffer"), summarize({drawn_ms, drawn_ms})});
  c.passes.push_back({parse_pass_name("generate.gbuffer.resolve"), summarize({computed_ms, computed_ms})});
  r.cases = {c};
  return r;
}

bool says_slow(const Report& r) {
  for (const std::string& note : table_notes(r, "", ""))
    if (note.find("raster is slow on this device") != std::string::npos) return true;
  return false;
}

}  // namespace

TEST(Raster, IsSlowBesideAComputePassOfAsManyBytes) {
  const Report h200 = report(6.644, 0.092);
  EXPECT_NEAR(*raster_ratio(h200), 72.2, 0.1);
  EXPECT_TRUE(says_slow(h200));
  EXPECT_FALSE(says_slow(report(0.2, 0.1)));
}

TEST(Raster, IsNotJudgedByTriangles) {
  EXPECT_FALSE(raster_ratio(report(6, 0.1, 600'000)));
  EXPECT_FALSE(says_slow(report(6, 0.1, 600'000)));
}

TEST(Raster, OfACpuIsNoNews) {
  Report cpu = report(6.644, 0.092);
  cpu.device.type = "cpu";
  EXPECT_FALSE(says_slow(cpu));
}

TEST(Raster, NeedsBothPasses) {
  Report half = report(6, 0.1);
  half.cases[0].passes.pop_back();
  EXPECT_FALSE(raster_ratio(half));
}
