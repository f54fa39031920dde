// Memory does not grow with the number of frames.
#include <sys/resource.h>

#include "run/motion_fixture.h"

namespace vsglbench {
namespace {

using MotionMemoryTest = MotionFixture;

// Of the largest worker so far.
double worker_megabytes() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

// An image has 0.4 MB: one that were kept of each of 56 frames would show as 21 MB.
TEST_F(MotionMemoryTest, SixtyFourFramesTakeWhatEightDo) {
  config_["frame"] = {{"width", 240}, {"height", 136}};
  use(ring_scene(64));  // with a layer of what stands still
  config_["methods"] = {{{"method", "mfis-mh"}, {"chains", "carried"}}};
  config_["motion"] = {{"frames", 8}};
  EXPECT_EQ(run().at(0).temporal.value().frames, 8u);
  const double few = worker_megabytes();
  config_["motion"] = {{"frames", 64}};
  EXPECT_EQ(run().at(0).temporal.value().frames, 64u);
  EXPECT_LT(worker_megabytes(), few + 10);
}

}  // namespace
}  // namespace vsglbench
