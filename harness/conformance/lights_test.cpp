// The rules on one light record, without a device.
#include "conformance/lights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace vsglbench;
using testing::HasSubstr;

TEST(ConformanceLights, EachRuleOfAVsgl) {
  const gpu::Vsgl good{.mean = {1, 2, 3},
                       .variance = 0.1f,
                       .diffuse = glm::vec3(0),
                       .diffuse_sharpness = 2,
                       .diffuse_axis = {0, 1, 0},
                       .level = 0,
                       .specular = glm::vec3(0),
                       .specular_sharpness = 0,
                       .specular_axis = {0, 1, 0},
                       .power = 0};
  EXPECT_EQ(fault_of(good), "");
  const auto fault_with = [&](auto change) {
    gpu::Vsgl light = good;
    light.specular = glm::vec3(1);
    light.power = static_cast<float>(4 * M_PI);  // a lobe of sharpness 0 and amplitude 1
    change(light);
    return fault_of(light);
  };
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(fault_with([](auto&) {}), "");
  EXPECT_THAT(fault_with([&](auto& v) { v.variance = nan; }),
              HasSubstr("has variance nan; expected a finite number > 0"));
  EXPECT_THAT(fault_with([](auto& v) { v.variance = 0; }), HasSubstr("variance 0"));
  EXPECT_THAT(fault_with([](auto& v) { v.power = -1; }), HasSubstr("power -1"));
  EXPECT_THAT(fault_with([](auto& v) { v.power *= 1.01f; }), HasSubstr("states a power"));
  EXPECT_THAT(fault_with([](auto& v) { v.specular.y = -1e-9f; }), HasSubstr("specular ("));
  EXPECT_THAT(fault_with([&](auto& v) { v.mean.z = inf; }), HasSubstr("mean (1, 2, inf)"));
  EXPECT_THAT(fault_with([](auto& v) { v.diffuse_sharpness = -1; }), HasSubstr("diffuse sharpness -1"));
  EXPECT_THAT(fault_with([](auto& v) { v.specular_axis.x = 0.1f; }),
              HasSubstr("specular axis of length 1.00499"));
  EXPECT_THAT(fault_with([&](auto& v) { v.level = nan; }), HasSubstr("level nan"));
}

TEST(ConformanceLights, EachRuleOfAVpl) {
  const gpu::Vpl good{.position = {1, 2, 3},
                      .ndf = 0.5f,
                      .normal = {0, 1, 0},
                      .power = 1,
                      .geometric_normal = {0, 1, 0},
                      .incident = {0, 1, 0},
                      .flux = glm::vec3(1),
                      .diffuse = glm::vec3(0.5f),
                      .f0 = glm::vec3(0.04f)};
  EXPECT_EQ(fault_of(good), "");
  const auto fault_with = [&](auto change) {
    gpu::Vpl light = good;
    change(light);
    return fault_of(light);
  };
  EXPECT_THAT(fault_with([](auto& v) { v.flux.x = -1; }), HasSubstr("flux (-1, 1, 1)"));
  EXPECT_THAT(fault_with([](auto& v) { v.normal = glm::vec3(0); }), HasSubstr("normal of length 0"));
  EXPECT_THAT(fault_with([](auto& v) { v.incident *= 2; }), HasSubstr("incident direction of length 2"));
  EXPECT_THAT(fault_with([](auto& v) { v.ndf = 0; }), HasSubstr("ndf 0"));
  EXPECT_THAT(fault_with([](auto& v) { v.diffuse.x = NAN; }), HasSubstr("diffuse reflectance (nan"));
  EXPECT_THAT(fault_with([](auto& v) { v.power = 2; }), HasSubstr("states a power of 2 W but carries 1 W"));
}
