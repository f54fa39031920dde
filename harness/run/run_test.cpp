// Small runs on the device: what they write, and how they go on.
#include "run/runner.h"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/exr.h"
#include "image/png.h"
#include "report/noise.h"
#include "run/run_fixture.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class RunTest : public RunFixture {
 protected:
  RunOutcome run(const std::vector<std::string>& only = {}, bool force = false) {
    RunOptions options;
    options.config = write_config();
    options.out = out_;
    options.only = only;
    options.force = force;
    options.argv = {"vsglbench", "run"};
    return run_config(options);
  }
  Report report() const { return read_report(out_ / "report.json"); }
};

const CaseResult& find(const Report& report, const std::string& id) {
  for (const auto& c : report.cases) {
    if (c.id == id) return c;
  }
  throw std::out_of_range(id);
}

void expect_passes(const CaseResult& c, bool has_importance) {
  for (const auto& [pass, ms] : c.passes)
    EXPECT_EQ(ms.samples.size(), c.frame->span.samples.size()) << c.id << ' ' << pass.name();
  const auto has = [&](PassStage stage, std::optional<Half> half) {
    return std::ranges::any_of(c.passes, [&](const PassTiming& p) {
      return p.pass.stage == stage && (!half || p.pass.half == half);
    });
  };
  for (const Half half : {Half::gbuffer, Half::rsm}) EXPECT_TRUE(has(PassStage::draw, half)) << c.id;
  EXPECT_TRUE(has(PassStage::generate, Half::rsm)) << c.id;
  EXPECT_TRUE(has(PassStage::shade, {})) << c.id;
  EXPECT_EQ(has(PassStage::importance, {}), has_importance) << c.id;
  EXPECT_EQ(has(PassStage::generate, Half::gbuffer), has_importance) << c.id;
}

TEST_F(RunTest, WritesAReportThatHoldsEverything) {
  config_["methods"] = {
      {{"method", "vpl"}}, {{"method", "fis"}}, {{"method", "mfis"}}, {{"method", "all-texels"}}};
  const RunOutcome outcome = run();
  EXPECT_EQ(outcome.exit_code, 0);
  expect_sound(out_ / "report.json");
  const Report r = report();
  EXPECT_TRUE(r.complete);
  ASSERT_EQ(r.cases.size(), 4u);
  for (const auto& c : r.cases) {
    EXPECT_EQ(c.status, Status::ok) << c.id;
    for (const MetricResult* m : {&c.accuracy->smape, &c.accuracy->rmse, &c.accuracy->bias}) {
      ASSERT_TRUE(m->value.has_value());
      EXPECT_TRUE(std::isfinite(*m->value));
    }
    EXPECT_EQ(c.health->nan + c.health->inf, 0u);
    EXPECT_EQ(c.seeds.size(), c.method == "all-texels" ? 1u : 2u);
    EXPECT_EQ(c.generate->lights, c.method == "all-texels" ? 256u : 16u);
    EXPECT_GT(c.generate->shaders, 0u);
    EXPECT_GT(c.frame->span.median, 0);
    EXPECT_LT(c.frame->method->median, c.frame->span.median);
    ASSERT_TRUE(c.frame->host_visibility) << c.id;
    // Warm-up and seed 0 have the same lights, which are traced once.
    EXPECT_EQ(c.frame->host_visibility->samples.size(), c.method == "all-texels" ? 1u : 2u);
    EXPECT_GT(c.frame->host_visibility->min, 0);
    EXPECT_EQ(c.stopping->frames, 2u);
    expect_passes(c, c.method != "all-texels");
  }
  ASSERT_EQ(r.aa.size(), 1u);
  EXPECT_EQ(r.aa[0].scene, "cornell");
  EXPECT_EQ(r.aa[0].case_id, r.cases.front().id);
  std::vector<std::string> times;
  for (const TimeNoise& time : r.aa[0].times) times.push_back(time.column);
  std::vector<std::string> expected = time_columns();
  std::erase(expected, "visibility");  // exact needs no shadow maps
  EXPECT_EQ(times, expected);
  EXPECT_TRUE(r.host.load_at_start && r.host.load_at_end);
  EXPECT_EQ(r.scenes.at(0).triangles, 30u);
}

TEST_F(RunTest, WritesImagesThatCanBeRead) {
  run();
  const Report r = report();
  const CaseResult& c = r.cases.at(0);
  for (const char* kind : {"indirect", "reference", "error"}) {
    const fs::path exr = out_ / c.images.at(kind);
    EXPECT_EQ(read_exr(exr).width, 32u) << exr;
    EXPECT_EQ(read_exr(exr).height, 18u) << exr;
    const Bitmap preview = read_png(fs::path(exr).replace_extension(".png"));
    EXPECT_EQ(preview.width, 32u);
    EXPECT_EQ(preview.height, 18u);
  }
  EXPECT_GT(read_png(out_ / r.scenes.at(0).contact).width, 400u);
  EXPECT_EQ(read_exr(out_ / "images/cornell/direct.exr").width, 32u);
}

// SMAPE as anybody would compute it from the files alone.
TEST_F(RunTest, AStrangerFindsTheSameErrorInTheFiles) {
  run();
  const Report r = report();
  const CaseResult& c = r.cases.at(0);
  const ExrLayers x = read_exr_layers(out_ / c.images.at("indirect")),
                  y = read_exr_layers(out_ / c.images.at("reference")),
                  error = read_exr_layers(out_ / c.images.at("error"));
  double sum = 0, whole = 0, pixels = 0, coverage = 0;
  for (size_t i = 0; i < 32 * 18; ++i) {
    const bool counts = x.scalars.at("A")[i] == 1 && y.scalars.at("A")[i] == 1;
    EXPECT_EQ(error.scalars.at("A")[i], x.scalars.at("A")[i]);
    pixels += counts;
    coverage += x.scalars.at("A")[i];
    for (int k = 0; k < 3; ++k) {
      const double a = x.colors.at("").pixels[i][k], b = y.colors.at("").pixels[i][k];
      const double e = a == b ? 0 : 2 * std::abs(a - b) / (std::abs(a) + std::abs(b));
      whole += e;
      sum += counts ? e : 0;
    }
  }
  EXPECT_EQ(pixels, c.accuracy->pixels);
  EXPECT_EQ(pixels, coverage);  // one file of the two is enough
  EXPECT_LT(pixels, 32 * 18);
  EXPECT_NEAR(100 * sum / (3 * pixels), c.seeds.at(0).errors.smape, 1e-9);
  EXPECT_GT(std::abs(100 * whole / (3 * 32 * 18) - c.seeds.at(0).errors.smape), 0.1);
  EXPECT_EQ(read_exr_layers(out_ / "images/cornell/direct.exr").scalars.at("A").size(), 32u * 18);
}

TEST_F(RunTest, EveryMetricAndItsFloorIsInTheReport) {
  run();
  const Report r = report();
  const Accuracy& a = *r.cases.at(0).accuracy;
  for (const MetricResult* m : {&a.smape, &a.rmse, &a.rrmse, &a.mrse, &a.bias, &a.smape_lit, &a.flip})
    EXPECT_TRUE(m->value) << m->formula << ": " << m->undefined;
  EXPECT_EQ(a.flip.constants.at("seeds"), 2);
  EXPECT_GE(a.flip.constants.at("exposures"), 2);
  EXPECT_LT(a.flip.constants.at("start_exposure"), a.flip.constants.at("stop_exposure"));
  EXPECT_GT(*a.flip_p99, *a.flip.value);
  EXPECT_GT(*a.lit_share, 0.1);
  const ReferenceInfo& f = a.reference;
  for (const auto& floor : {std::optional(f.noise_floor_smape), f.noise_floor_rmse, f.noise_floor_smape_lit,
                            f.noise_floor_rrmse, f.noise_floor_mrse, f.noise_floor_flip}) {
    ASSERT_TRUE(floor);
    EXPECT_GT(*floor, 0);
  }
  // A closed room of grey walls: of the order of the share that they send back.
  EXPECT_GT(*f.light_ratio, 0.05);
  EXPECT_LT(*f.light_ratio, 2);
}

TEST_F(RunTest, WallTimeAddsUp) {
  const WallTime wall = run().report.wall;
  EXPECT_GT(wall.device_s, 0);
  EXPECT_GT(wall.references_s, 0);
  EXPECT_GT(wall.visibility_s, 0);
  EXPECT_GT(wall.compilation_s, 0);
  EXPECT_GE(wall.total_s, wall.device_s + wall.references_s + wall.visibility_s + wall.compilation_s);
  EXPECT_GT(wall.overhead_ratio, 1);
  EXPECT_EQ(report().wall.device_s, wall.device_s);
}

TEST_F(RunTest, OnlyTakesAGlobOverIds) {
  config_["methods"] = {{{"method", "vpl"}, {"N", {4, 8}}}, {{"method", "fis"}}};
  run({"*/vpl/N=8,*"});
  ASSERT_EQ(report().cases.size(), 1u);
  EXPECT_EQ(report().cases[0].id, "cornell/vpl/N=8,rsm=16,vis=exact");
  run({"*/vpl/N=8,*", "*/fis/*"});
  EXPECT_EQ(report().cases.size(), 2u);
  EXPECT_THROW(run({"*/fis/*", "nothing*"}), Error);
}

// The twin of the A/A pair is one of a case that can be measured; the failed ones are failed, the rest is
// not.
TEST_F(RunTest, ImpossibleNumbersOfLightsFailTheirCasesOnly) {
  config_["methods"] = {{{"method", "vpl"}, {"N", {0, 8, 256, 257}}}};
  const RunOutcome outcome = run();
  EXPECT_EQ(outcome.exit_code, 1);
  const Report r = report();
  expect_sound(out_ / "report.json");
  EXPECT_EQ(find(r, "cornell/vpl/N=0,rsm=16,vis=exact").status, Status::failed);
  EXPECT_EQ(find(r, "cornell/vpl/N=257,rsm=16,vis=exact").status, Status::failed);
  EXPECT_TRUE(contains(find(r, "cornell/vpl/N=257,rsm=16,vis=exact").error->message, "use 1 … 256"));
  EXPECT_EQ(find(r, "cornell/vpl/N=256,rsm=16,vis=exact").status, Status::ok);
  EXPECT_EQ(r.aa.at(0).case_id, "cornell/vpl/N=8,rsm=16,vis=exact");
}

TEST_F(RunTest, VisibilitiesHaveTheirOwnReferences) {
  config_["visibility"] = {"exact", "none", "ism"};
  EXPECT_EQ(run().exit_code, 0);
  const Report r = report();
  const auto hash = [&](const char* vis) {
    return find(r, fmt::format("cornell/vpl/N=16,rsm=16,vis={}", vis)).accuracy->reference.hash;
  };
  for (const auto& c : r.cases)  // only `exact` asks the host for rays
    EXPECT_EQ(c.frame->host_visibility.has_value(), c.id.ends_with("vis=exact")) << c.id;
  EXPECT_EQ(hash("exact"), hash("ism"));
  EXPECT_NE(hash("exact"), hash("none"));
}

TEST_F(RunTest, TheSmallestSizesRun) {
  config_["methods"] = {
      {{"method", "vpl"}}, {{"method", "fis"}}, {{"method", "mfis"}}, {{"method", "all-texels"}}};
  config_["N"] = 1;
  for (const auto& [width, height, rsm] : {std::tuple{1, 1, 16}, std::tuple{7, 5, 1}, std::tuple{7, 5, 3}}) {
    config_["frame"] = {{"width", width}, {"height", height}};
    config_["rsm"] = rsm;
    const RunOutcome outcome = run();
    for (const auto& c : outcome.report.cases) {
      EXPECT_EQ(c.status, Status::ok) << c.id << ": " << (c.error ? c.error->message : "");
    }
    expect_sound(out_ / "report.json");
  }
}

TEST_F(RunTest, ASceneByPathCannotWriteElsewhere) {
  config_["scenes"] = {write_scene("deep", square_scene(), box_gltf().dump())};
  EXPECT_EQ(run().exit_code, 0);
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
    const std::string path = entry.path().string();
    const bool outside = !path.starts_with(out_.string());
    EXPECT_FALSE(outside && entry.path().extension() == ".exr") << path;
  }
  const Report r = report();
  EXPECT_TRUE(r.cases.at(0).images.at("indirect").starts_with("images/_"))
      << r.cases.at(0).images.at("indirect");
  EXPECT_TRUE(fs::exists(out_ / r.cases.at(0).images.at("indirect")));
}

// From the files alone, by the channel A of pixels that count.
TEST_F(RunTest, ErrorsInTheViewsRegionAreInTheReport) {
  Json scene = square_scene();
  scene["views"]["front"]["region"] = {0.25, 0.5, 1, 1};
  config_["scenes"] = {write_scene("parted", scene, box_gltf().dump())};
  EXPECT_EQ(run().exit_code, 0);
  expect_sound(out_ / "report.json");
  const Report r = report();
  EXPECT_EQ(r.scenes.at(0).region, (Crop{8, 9, 24, 9}));
  EXPECT_EQ(r.scenes[0].warnings, std::vector<std::string>());
  const CaseResult& c = r.cases.at(0);
  const ExrLayers x = read_exr_layers(out_ / c.images.at("indirect")),
                  y = read_exr_layers(out_ / c.images.at("reference"));
  double sum = 0, values = 0;
  for (size_t i = 0; i < 32 * 18; ++i) {
    if (i % 32 < 8 || i / 32 < 9 || x.scalars.at("A")[i] != 1 || y.scalars.at("A")[i] != 1) continue;
    for (int k = 0; k < 3; ++k) {
      const double d = double(x.colors.at("").pixels[i][k]) - y.colors.at("").pixels[i][k];
      sum += d * d;
      values += 1;
    }
  }
  ASSERT_EQ(c.seeds.size(), 2u);
  for (const SeedResult& seed : c.seeds) {
    ASSERT_TRUE(seed.region);
    EXPECT_NE(seed.region->rmse, seed.errors.rmse);
    EXPECT_TRUE(seed.detail && seed.region->detail && seed.region->bias && seed.spikes);
  }
  EXPECT_NEAR(c.seeds[0].region->rmse, std::sqrt(sum / values), 1e-9);
  EXPECT_NE(c.seeds[0].region->rmse, c.seeds[1].region->rmse);
}

// The camera sees past the box there: the case is sound, and the scene says why it has no such errors.
TEST_F(RunTest, ARegionWithoutASurfaceIsAWarning) {
  Json scene = square_scene();
  scene["views"]["front"]["region"] = {0, 0.4, 0.05, 0.6};
  config_["scenes"] = {write_scene("parted", scene, box_gltf().dump())};
  EXPECT_EQ(run().exit_code, 0);
  expect_sound(out_ / "report.json");
  const Report r = report();
  EXPECT_EQ(r.scenes.at(0).region, (Crop{0, 7, 2, 4}));
  ASSERT_EQ(r.scenes[0].warnings.size(), 1u);
  EXPECT_TRUE(contains(r.scenes[0].warnings[0], "no surface in the view's region at 32x18"));
  for (const SeedResult& seed : r.cases.at(0).seeds) EXPECT_TRUE(!seed.region && seed.detail);
}

TEST_F(RunTest, EverySeedHasItsCancellationRate) {
  config_["methods"] = {{{"method", "mfis"}, {"bias_reduction", {0, 0.1}}}};
  config_["scenes"] = {"cornell-glossy"};
  EXPECT_EQ(run().exit_code, 0);
  expect_sound(out_ / "report.json");
  const Report r = report();
  ASSERT_EQ(r.cases.size(), 2u);
  for (const CaseResult& c : r.cases) {
    ASSERT_EQ(c.seeds.size(), 2u);
    const bool reduces = c.parameters.value("bias_reduction", 0.0) > 0;
    for (const SeedResult& seed : c.seeds) EXPECT_EQ(seed.cancellation_rate.has_value(), reduces) << c.id;
    if (!reduces) continue;
    EXPECT_EQ(c.seeds[0].cancellation_rate, c.shading->cancellation_rate);
    EXPECT_NE(c.seeds[0].cancellation_rate, c.seeds[1].cancellation_rate);
    EXPECT_GT(*c.seeds[1].cancellation_rate, 0);
    EXPECT_LT(*c.seeds[1].cancellation_rate, 1);
  }
}

TEST_F(RunTest, AnotherRunInTheSameFolderIsRefused) {
  fs::create_directories(out_);
  const int lock = ::open(out_.c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  try {
    run();
    ADD_FAILURE() << "no error";
  } catch (const Error& e) {
    EXPECT_TRUE(contains(e.what(), "another run is writing there"));
  }
  ::close(lock);
}

}  // namespace
}  // namespace vsglbench
