// The approximations of shading on the device, each held to the committed errors against the rendering
// integral.
#include "operation/approximations.h"

#include <gtest/gtest.h>

#include "base/file.h"
#include "operation/approximation_table.h"

using namespace vsglbench;

namespace {

Device& device() {
  static Device d;
  return d;
}

}  // namespace

class Approximation : public ::testing::TestWithParam<std::string> {};

TEST_P(Approximation, HasTheTabledErrors) {
  const auto measured = approximation_errors(device(), GetParam());
  const auto differences = differences_from_table(GetParam(), measured);
  for (const std::string& d : differences) ADD_FAILURE() << d;
  if (differences.empty()) return;
  const auto file = std::filesystem::path(testing::TempDir()) / (GetParam() + ".csv");
  write_text(file, to_csv(GetParam(), measured));
  std::printf("what was measured stands in %s\n", file.c_str());
}

INSTANTIATE_TEST_SUITE_P(Oracles, Approximation, ::testing::ValuesIn(oracle_names()),
                         [](const auto& oracle) { return oracle.param; });

// What the table means: where the approximation is good, and what gets worse with what.
TEST(Approximations, AreGoodWhereTheyShouldBe) {
  const auto receiver = tabled_errors("receiver");
  for (const char* place : {"on axis", "in plane, towards", "across"}) {
    const auto& error = receiver.at(std::string("Phong 1023 F0 1 under 1023 ") + place);
    for (size_t k = 0; k + 2 < error.size(); ++k) EXPECT_LT(std::abs(error[k]), 0.03) << place;  // to 60°
  }
  for (const char* oracle : {"gaussian", "disk", "cancelled", "filtered_brdfs"}) {
    for (const auto& [name, error] : tabled_errors(oracle)) {
      if (name.find("d/sigma 100") == std::string::npos && name.find("r/d 0.001") == std::string::npos)
        continue;
      for (size_t k = 0; k < error.size(); ++k)
        EXPECT_LT(std::abs(error[k]), k + 1 < error.size() ? 0.01 : 0.05) << oracle << " " << name;
    }
  }
}

// Between Lambert surfaces a disk is exact where the receiver's horizon doesn't cut it, and within 15 % where
// it does but leaves the disk's centre well above it.
TEST(Approximations, BetweenLambertSurfacesAreExactButForTheHorizon) {
  const auto errors = tabled_errors("filtered_brdfs");
  for (const auto& [radius, uncut, cut] :
       {std::tuple("0.03", kViewAngles, kViewAngles), {"0.3", kViewAngles - 2, kViewAngles}, {"1.5", 3, 6}}) {
    const auto& error = errors.at(std::string("Lambert from Lambert r/d ") + radius);
    for (size_t k = 0; k < cut; ++k)
      EXPECT_LT(std::abs(error[k]), k < uncut ? 1e-5 : 0.15) << radius << " " << k;
  }
}

// z = (estimate - integral)/standard error, which is normal for this many runs.
TEST(SphericalLights, AreEstimatedWithoutBias) {
  const auto errors = vsl_errors(device(), 512);
  double square = 0;
  for (const SampledError& e : errors) {
    const double z = e.error / e.standard_error;
    EXPECT_LT(std::abs(z), 5) << e.name << ": " << e.error << " ± " << e.standard_error;
    square += z * z / static_cast<double>(errors.size());
  }
  EXPECT_GT(square, 0.6);
  EXPECT_LT(square, 1.5);
}

TEST(Cancellation, IsDecidedByTheLobesCurvature) {
  for (const std::string& line : wrong_cancellations(device())) ADD_FAILURE() << line;
}
