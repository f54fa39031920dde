// Two hundred random scenes; the first of them are tried in effects_test.cpp.
#include <gtest/gtest.h>

#include "run/random_scene.h"

using namespace vsglbench;

TEST(EffectsRandom, TwoHundredScenesGiveTheImageOfAllEffects) { expect_random_scenes_equal(200, true); }
