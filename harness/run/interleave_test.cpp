// Lights that the pixels of a block share out, against the same lights at every pixel.
#include <gtest/gtest.h>

#include "run/laboratory.h"

using namespace vsglbench;

namespace {

constexpr uint32_t kLights = 256;

class Interleaving : public ::testing::TestWithParam<const char*> {
 protected:
  Image render(uint32_t interleave, uint32_t lights = kLights) {
    return lab_.render(
        "mfis", Json::object(),
        {.rsm = 64, .lights = lights, .visibility = Visibility::none, .interleave = interleave});
  }
  Laboratory lab_{GetParam()};
};

// Nearer to all lights at every pixel than the few lights are that a pixel has time for.
TEST_P(Interleaving, IsNearerThanAsFewLightsForEach) {
  const Image all = render(1);
  double last = 0;
  for (const uint32_t block : {2u, 4u}) {
    const Errors shared = measure_errors(render(block), all, lab_.mask),
                 few = measure_errors(render(1, kLights / (block * block)), all, lab_.mask);
    std::printf("%s, %u: SMAPE %.3f %%, bias %+.3f %%; of %u lights each %.3f %%\n", GetParam(), block,
                shared.smape, 100 * *shared.bias, kLights / (block * block), few.smape);
    EXPECT_LT(shared.smape, few.smape);
    EXPECT_LT(100 * std::abs(*shared.bias), 0.25 * shared.smape);  // it errs to both sides
    EXPECT_GT(shared.smape, last);                                 // a wider window joins what differs more
    last = shared.smape;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Interleaving, ::testing::Values("cornell", "cornell-glossy", "colonnade"));

}  // namespace
