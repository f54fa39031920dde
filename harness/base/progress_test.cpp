#include "base/progress.h"

#include <gtest/gtest.h>

#include <thread>

namespace vsglbench {
namespace {

// What a pipe gets while `steps` of ten are done, each in `step_ms`.
std::string piped(uint64_t steps, int step_ms, double line_every_s) {
  testing::internal::CaptureStderr();
  {
    Progress progress("cornell/mfis", 10, line_every_s);
    for (uint64_t i = 0; i < steps; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(step_ms));
      progress.advance();
    }
  }
  return testing::internal::GetCapturedStderr();
}

TEST(Progress, APipeGetsALineNowAndThen) {
  EXPECT_EQ(piped(1, 100, 0.05), "10 %, 1 s left: cornell/mfis\n");
  EXPECT_EQ(piped(2, 1, 0), "10 %, 0 s left: cornell/mfis\n20 %, 0 s left: cornell/mfis\n");
  EXPECT_EQ(piped(10, 1, 10), "");
}

}  // namespace
}  // namespace vsglbench
