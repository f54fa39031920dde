#include "report/report.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "base/file.h"
#include "report/synthetic_report.h"

namespace fs = std::filesystem;
using namespace vsglbench;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class ReportFile : public testing::Test {
 protected:
  fs::path dir_ = fs::temp_directory_path() / ("vsglbench_report_test_" + std::to_string(::getpid()));
  fs::path path_ = dir_ / "report.json";
  void TearDown() override { fs::remove_all(dir_); }
};

std::string message_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return e.what();
  }
  return "no error";
}

}  // namespace

TEST_F(ReportFile, ReadsBackEveryField) {
  const Report report = synthetic_report();
  write_report(path_, report);
  const Report read = read_report(path_);
  EXPECT_EQ(to_json(read).dump(), to_json(report).dump());
  EXPECT_EQ(read.cases[0].accuracy->smape.value, report.cases[0].accuracy->smape.value);
  EXPECT_EQ(read.cases[0].passes[3].ms.samples, report.cases[0].passes[3].ms.samples);
  EXPECT_EQ(read.cases[0].seeds[5].errors.pixels, 1000u);
  EXPECT_EQ(read.cases[1].health->first_bad->pixel, glm::uvec2(7, 9));
  EXPECT_EQ(read.scenes[0].region, (Crop{1, 4, 30, 13}));
  const SeedResult &seed = read.cases[0].seeds[5], &was = report.cases[0].seeds[5];
  EXPECT_EQ(seed.detail, was.detail);
  EXPECT_EQ(seed.spikes, was.spikes);
  EXPECT_EQ(seed.cancellation_rate, was.cancellation_rate);
  ASSERT_TRUE(seed.region);
  EXPECT_EQ(seed.region->smape, 14);
  EXPECT_EQ(seed.region->rmse, 0.03);
  EXPECT_EQ(seed.region->bias, -0.02);
  EXPECT_EQ(seed.region->detail, was.region->detail);
  EXPECT_EQ(read.cases[2].status, Status::skipped);
}

TEST(Report, PartsComeBackAsTheyWere) {
  const Report report = synthetic_report();
  const auto same = []<class T>(const T& part) {
    const Json json = part_to_json(part);
    EXPECT_EQ(part_to_json(part_from_json<T>(Json::parse(json.dump()))).dump(), json.dump());
  };
  for (const auto& c : report.cases) same(c);
  same(synthetic_generation("cornell/fis", 3));
  same(report.aa[0]);
  same(report.aa[0].times[0]);
  same(report.device);
  same(report.scenes[0]);
  same(report.wall);
  EXPECT_EQ(part_from_json<CaseResult>(part_to_json(report.cases[0])).seeds[5].errors.pixels, 1000u);
}

// One pair for all scenes, of the frame's time only; no time of the method.
TEST_F(ReportFile, ReportsOfOldAreRead) {
  Json old = to_json(synthetic_report());
  old["aa"] = {{"case", "cornell/mfis"},
               {"twin", "cornell/mfis#twin"},
               {"ratio", 1.01},
               {"ci95", {0.99, 1.02}},
               {"noise_floor", 0.02}};
  old["cases"][0]["frame"].erase("method");
  old["cases"][0]["frame"].erase("host_visibility");
  old["scenes"][0].erase("region");
  for (Json& seed : old["cases"][0]["seeds"]) {
    for (const char* key : {"detail", "spikes", "cancellation_rate", "region"}) seed.erase(key);
  }
  write_text(path_, old.dump());
  const Report r = read_report(path_);
  ASSERT_EQ(r.aa.size(), 1u);
  EXPECT_EQ(r.aa[0].scene, "cornell");
  ASSERT_EQ(r.aa[0].times.size(), 1u);
  EXPECT_EQ(r.aa[0].times[0].column, "frame");
  EXPECT_EQ(r.aa[0].times[0].noise_floor, 0.02);
  EXPECT_EQ(r.cases[0].frame->method->samples, synthetic_report().cases[0].frame->method->samples);
  EXPECT_FALSE(r.cases[0].frame->host_visibility);
  const SeedResult& seed = r.cases[0].seeds.at(3);
  EXPECT_FALSE(seed.detail || seed.spikes || seed.cancellation_rate || seed.region || r.scenes[0].region);
}

TEST_F(ReportFile, NumbersThatAreNotFiniteAreNamedAndNothingIsWritten) {
  write_report(path_, synthetic_report());
  const std::string before = read_text(path_);
  Report report = synthetic_report();
  report.cases[0].passes[1].ms.samples[2] = kNaN;
  EXPECT_NE(message_of([&] { write_report(path_, report); }).find("'cases/0/passes/1/samples_ms/2' is nan"),
            std::string::npos);
  report = synthetic_report();
  report.cases[0].accuracy->bias.value = std::numeric_limits<double>::infinity();
  EXPECT_NE(message_of([&] { write_report(path_, report); }).find("'cases/0/accuracy/bias/value' is inf"),
            std::string::npos);
  report = synthetic_report();
  report.config["limit"] = kNaN;  // in the free-form part too
  EXPECT_NE(message_of([&] { write_report(path_, report); }).find("'config/limit'"), std::string::npos);
  EXPECT_EQ(read_text(path_), before);
}

TEST_F(ReportFile, AReportThatDisobeysTheSchemaIsNotWritten) {
  Report report = synthetic_report();
  report.cases[0].accuracy.reset();
  EXPECT_NE(message_of([&] { write_report(path_, report); }).find("lacks 'accuracy'"), std::string::npos);
  report = synthetic_report();
  report.cases[1].error->message = "\xff\xfe";  // not UTF-8
  EXPECT_NE(message_of([&] { write_report(path_, report); }), "no error");
  EXPECT_FALSE(fs::exists(path_));
}

TEST_F(ReportFile, ADamagedFileIsOneClearLine) {
  write_report(path_, synthetic_report());
  const std::string whole = read_text(path_);
  for (size_t length = 0; length + 2 < whole.size(); length += 97) {
    write_text(path_, whole.substr(0, length));
    EXPECT_NE(message_of([&] { read_report(path_); }).find("report.json:"), std::string::npos) << length;
  }
  std::string broken = whole;
  broken.replace(broken.find("\"failed\""), 8, "\"fialed\"");
  write_text(path_, broken);
  EXPECT_NE(message_of([&] { read_report(path_); }).find("did you mean 'failed'?"), std::string::npos);
  EXPECT_NE(message_of([&] { read_report(dir_ / "absent.json"); }), "no error");
}

// Which would be waited on for a writer.
TEST_F(ReportFile, APipeIsRefused) {
  const fs::path pipe = dir_ / "pipe.json";
  fs::create_directories(dir_);
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  try {
    read_report(pipe);
    ADD_FAILURE() << "read";
  } catch (const Error& e) {
    EXPECT_EQ(e.exit_code(), 2);
    EXPECT_NE(std::string(e.what()).find("is a pipe or a device, not a file"), std::string::npos) << e.what();
  }
}

TEST_F(ReportFile, KeepsListsOfSamplesOnOneLine) {
  write_report(path_, synthetic_report());
  EXPECT_NE(read_text(path_).find("\"samples_ms\": [2.0,2.5,1.5,2.0]"), std::string::npos);
  EXPECT_EQ(JsonDocument::load(path_, ErrorKind::config).root().dump(), to_json(synthetic_report()).dump());
}

PassTiming timing(const std::string& pass, std::vector<double> ms) {
  return {parse_pass_name(pass), summarize(std::move(ms))};
}

TEST(Report, SumsPassesFrameByFrame) {
  const std::vector<PassTiming> passes = {timing("generate.gbuffer.a", {1, 2, 3}),
                                          timing("generate.rsm.b", {30, 20, 10}),
                                          timing("generated", {100, 100, 100}), timing("shade", {5, 5, 5})};
  EXPECT_EQ(generate_time(passes)->samples, (std::vector<double>{31, 22, 13}));
  EXPECT_EQ(generate_time(passes, Half::rsm)->samples, (std::vector<double>{30, 20, 10}));
  EXPECT_FALSE(generate_time({passes[0], passes[3]}, Half::rsm));
  EXPECT_THROW(generate_time({passes[0], timing("generate.rsm.c", {1})}), std::invalid_argument);
}

// What is read from a file is written as it was, whoever wrote it.
TEST(Report, APassHasTheNameThatItWasReadWith) {
  const auto parts = [](const char* name) { return parse_pass_name(name); };
  EXPECT_EQ(parts("gbuffer"), (PassId{PassStage::draw, Half::gbuffer, ""}));
  EXPECT_EQ(parts("importance.rsm"), (PassId{PassStage::importance, Half::rsm, ""}));
  EXPECT_EQ(parts("generate.rsm.sort"), (PassId{PassStage::generate, Half::rsm, "sort"}));
  EXPECT_EQ(parts("visibility.ism.pull"), (PassId{PassStage::visibility, std::nullopt, "ism.pull"}));
  EXPECT_EQ(parts("shade"), (PassId{.stage = PassStage::shade}));
  EXPECT_EQ(parts("generated"), (PassId{.step = "generated"}));
  for (const char* name :
       {"rsm", "importance.gbuffer", "generate.gbuffer.a.b", "generate.other.sort", "generate",
        "shade.texels", "direct", ".", "generate.", "generate.rsm.", "rsm.", "", "block"}) {
    EXPECT_EQ(parts(name).name(), name);
  }
}

TEST(Report, TheMethodsTimeIsAllButTheRasterisedPasses) {
  const std::vector<PassTiming> passes = {
      timing("gbuffer", {1000, 2000, 3000}),   timing("rsm", {100, 200, 300}),
      timing("importance.gbuffer", {1, 2, 3}), timing("generate.rsm.b", {30, 20, 10}),
      timing("visibility.ism", {7, 7, 7}),     timing("shade", {50, 50, 60})};
  const auto time = method_time(passes);
  ASSERT_TRUE(time);
  EXPECT_EQ(time->samples, (std::vector<double>{88, 79, 80}));
  EXPECT_EQ(time->median, 80);
  EXPECT_FALSE(method_time({passes[0], passes[1]}));
}

TEST(Report, AFrameIsItsPassesAndTheRest) {
  const FrameTiming f = frame_timing({10, 12, 11}, {timing("a", {4, 5, 4}), timing("b", {5, 5, 6})});
  EXPECT_EQ(f.span.median, 11);
  EXPECT_EQ(f.sum_ms, 10);
  EXPECT_EQ(f.unattributed_ms, 1);
  EXPECT_EQ(f.method->samples, (std::vector<double>{9, 10, 10}));
  EXPECT_THROW(frame_timing({10}, {timing("a", {4, 5})}), std::invalid_argument);
}

TEST(Report, TheClockReadsUtc) {
  const std::string now = utc_now();
  ASSERT_EQ(now.size(), 20u);
  EXPECT_EQ(now.back(), 'Z');
  EXPECT_GE(now.substr(0, 4), "2024");
}

// bias = -0.5 of a reference known to 2 % from 2 batches: Student's t of one degree of freedom is 12.706.
TEST(ReportAccuracy, TheIntervalOfBiasHoldsTheReferencesOwnError) {
  ReferenceInfo reference{"0123abcd", 64, 0.5, std::nullopt};
  const Errors errors{12, 0.02, 0.1, 0.3, -0.5, 1000};
  EXPECT_FALSE(accuracy_over_seeds({{0, errors}}, reference).bias.ci95);
  reference.batches = 2;
  reference.standard_error = 0.02;
  const Accuracy alone = accuracy_over_seeds({{0, errors}}, reference);
  ASSERT_TRUE(alone.bias.ci95);
  EXPECT_NEAR(alone.bias.ci95->hi, -0.5 + 12.706 * 0.02 * 0.5, 1e-4);
  EXPECT_NEAR(alone.bias.ci95->lo, -0.5 - 12.706 * 0.02 * 0.5, 1e-4);
  EXPECT_FALSE(alone.rmse.ci95);
  // Seeds -0.4 and -0.6: half width 12.706 * 0.1, in quadrature with the reference's.
  Errors less = errors, more = errors;
  less.bias = -0.4, more.bias = -0.6;
  const Accuracy both = accuracy_over_seeds({{0, less}, {1, more}}, reference);
  EXPECT_NEAR(both.bias.ci95->width() / 2, 12.706 * std::hypot(0.1, 0.01), 1e-3);
}
