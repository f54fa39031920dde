#include "reference/speed.h"

#include <gtest/gtest.h>

#include "reference/test_scenes.h"

namespace vsglbench {
namespace {

// Every ray counted is logged, and the log traces: whether the ratio is high enough is for the benchmark.
TEST(SpeedRatio, ReplaysTheRaysOfTheReference) {
  const Scene scene = test::slab_box();
  const Tracer tracer(scene);
  ReferenceParameters p;
  p.width = 48;
  p.height = 32;
  p.samples = 16;
  p.batches = 2;
  std::vector<RayLog> logs;
  const ReferenceResult logged = compute_reference(tracer, p, &logs);
  uint64_t rays = 0, shadow = 0, blocked = 0;
  for (const RayLog& log : logs) {
    rays += log.size();
    for (const LoggedRay& ray : log) {
      shadow += ray.shadow;
      blocked += ray.shadow && tracer.occluded(ray.origin, ray.origin + ray.direction);
    }
  }
  EXPECT_EQ(rays, logged.rays);
  EXPECT_GT(shadow, rays / 10);
  EXPECT_GT(blocked, 0u);
  EXPECT_LT(blocked, shadow);
  EXPECT_EQ(compute_reference(tracer, p).mean.pixels, logged.mean.pixels);  // the log changes nothing

  const SpeedRatio speed = measure_speed_ratio(scene, p, 1);
  EXPECT_EQ(speed.rays, rays);
  EXPECT_GT(speed.reference_seconds, 0);
  EXPECT_GT(speed.bare_seconds, 0);
  EXPECT_GT(speed.ratio(), 0);
}

}  // namespace
}  // namespace vsglbench
