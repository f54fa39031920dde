// `vsglbench metrics` on files of our own and of others.
#include <OpenEXR/ImfRgbaFile.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/json.h"
#include "cli/cli_fixture.h"
#include "image/exr.h"
#include "image/flip.h"

namespace vsglbench {
namespace {

class MetricsCommand : public CliTest {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  // Three pixels of one row, of which channel A counts those that `coverage` does.
  void write_pair(const Mask& coverage = {}) {
    write_exr(path("r.exr"), r_, coverage);
    write_exr(path("x.exr"), x_);
  }
  Image picture(std::vector<glm::vec3> pixels) const {
    Image image(static_cast<uint32_t>(pixels.size()), 1);
    image.pixels = std::move(pixels);
    return image;
  }
  Json metrics(std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"metrics", path("r.exr"), path("x.exr"), "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished f = run(arguments);
    EXPECT_EQ(f.code, 0) << f.err;
    return Json::parse(f.out);
  }
  Image r_ = picture({glm::vec3(1), glm::vec3(2), glm::vec3(4)}),
        x_ = picture({glm::vec3(3), glm::vec3(2), glm::vec3(2)});
};

TEST_F(MetricsCommand, SaysWhatTheLibraryMeasures) {
  write_pair();
  const Json json = metrics(), all = json.at("metrics");
  EXPECT_NEAR(all.at("smape").at("value").get<double>(), 100 * (1.0 + 0 + 2.0 / 3) / 3, 1e-9);
  EXPECT_NEAR(all.at("rmse").at("value").get<double>(), std::sqrt(8.0 / 3), 1e-9);
  EXPECT_NEAR(all.at("bias").at("value").get<double>(), 0, 1e-9);
  const FlipErrors flip = *measure_flip(x_, r_);
  EXPECT_NEAR(all.at("flip").at("value").get<double>(), flip.mean, 1e-9);
  EXPECT_EQ(all.at("flip").at("constants").at("exposures"), flip.exposures.count);
  EXPECT_EQ(json.at("pixels"), 3);
  for (const Metric m : kMetrics) EXPECT_EQ(all.at(formula(m).name).at("formula"), formula(m).id);
  const Finished text = run({"metrics", path("r.exr"), path("x.exr")});
  EXPECT_NE(text.out.find("rmse       1.63299\n"), std::string::npos) << text.out;
}

TEST_F(MetricsCommand, ChannelAOrAMaskChoosesThePixels) {
  write_pair({1, 0, 1});
  EXPECT_EQ(metrics().at("pixels"), 2);
  EXPECT_EQ(metrics().at("counted"), "A");
  write_exr(path("mask.exr"), picture({glm::vec3(0), {0, 0, 0.5f}, glm::vec3(0)}));
  const Json json = metrics({"--mask", path("mask.exr")});
  EXPECT_EQ(json.at("pixels"), 1);
  EXPECT_EQ(json.at("metrics").at("smape").at("value"), 0);
  write_pair({0, 0, 0});
  expect_refused(run({"metrics", path("r.exr"), path("x.exr")}), 1, "channel A is 0");
}

TEST_F(MetricsCommand, ReadsHalfFloats) {
  write_pair();
  const Imf::Rgba row[3] = {{3, 3, 3, 1}, {2, 2, 2, 1}, {2, 2, 2, 0}};
  {
    Imf::RgbaOutputFile file(path("x.exr").c_str(), 3, 1, Imf::WRITE_RGBA);
    file.setFrameBuffer(row, 1, 3);
    file.writePixels(1);
  }
  const Json json = metrics();
  EXPECT_EQ(json.at("pixels"), 2);
  EXPECT_NEAR(json.at("metrics").at("smape").at("value").get<double>(), 50, 1e-9);
}

TEST_F(MetricsCommand, RefusesWhatItCannotCompare) {
  write_pair();
  write_exr(path("wide.exr"), picture(std::vector<glm::vec3>(4, glm::vec3(1))));
  expect_refused(run({"metrics", path("r.exr"), path("wide.exr")}), 2, "4x1");
  expect_refused(run({"metrics", path("r.exr"), path("x.exr"), "--mask", path("wide.exr")}), 2,
                 "the mask is 4x1");
  x_.pixels[1].y = std::nanf("");
  write_exr(path("nan.exr"), x_);
  expect_refused(run({"metrics", path("r.exr"), path("nan.exr")}), 1,
                 "nan.exr: 1 NaN and 0 Inf pixels, the first at (1, 0)");
  write_exr(path("y.exr"), ExrLayers{3, 1, {}, {{"Y", {1, 2, 3}}}, {}});
  expect_refused(run({"metrics", path("r.exr"), path("y.exr")}), 2,
                 "lacks the channels R, G and B; it has Y");
  expect_refused(run({"metrics", path("absent.exr"), path("x.exr")}), 2, "absent.exr");
}

TEST_F(MetricsCommand, ABlackReferenceIsUndefinedAndNoFailure) {
  r_ = Image(3, 1);
  write_pair();
  const Json all = metrics().at("metrics");
  EXPECT_EQ(all.at("smape").at("value"), 200);
  for (const char* name : {"bias", "rrmse", "mrse", "smape_lit", "flip"}) {
    EXPECT_EQ(all.at(name).at("undefined"), "the reference is black") << name;
    EXPECT_FALSE(all.at(name).contains("value"));
  }
}

}  // namespace
}  // namespace vsglbench
