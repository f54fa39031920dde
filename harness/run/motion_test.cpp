// Flicker of scenes in motion, from the config to the report.
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <numeric>
#include <set>

#include "image/exr.h"
#include "image/flicker.h"
#include "image/labelled.h"
#include "run/frame_export.h"
#include "run/motion_fixture.h"
#include "run/motion_images.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

class MotionTest : public MotionFixture {
 protected:
  // A run anew that is killed when it begins an action.
  void kill_at(const std::string& action) const {
    const pid_t pid = ::fork();
    if (pid == 0) {
      RunOptions o = options();
      o.force = true;
      o.sabotage = [parent = ::getpid(), action](const Activity& a) {
        if (a.action == action) ::kill(parent, SIGKILL);
      };
      ::_exit(run_config(o).exit_code);
    }
    int status = 0;
    ::waitpid(pid, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << action;
  }
};

TEST_F(MotionTest, TheReportHasTheFlickerOfEveryFrame) {
  use(ring_scene(5));
  config_["seeds"] = 3;
  const std::vector<CaseResult> cases = run();
  ASSERT_EQ(cases.size(), 1u);
  ASSERT_TRUE(cases[0].temporal);
  const Temporal& t = *cases[0].temporal;
  EXPECT_EQ(t.frames, 5u);
  EXPECT_EQ(t.seeds, 4u);
  EXPECT_EQ(std::set<std::string>(t.references.begin(), t.references.end()).size(), 5u);
  ASSERT_EQ(t.derivative.series.size(), 4u);
  EXPECT_GT(t.derivative.value, 0);
  EXPECT_GE(t.derivative.p99, t.derivative.value);
  EXPECT_NEAR(t.derivative.value,
              std::accumulate(t.derivative.series.begin(), t.derivative.series.end(), 0.0) / 4,
              0.05 * t.derivative.value);  // but for the number of pixels in each
  EXPECT_EQ(t.derivative.series.at(t.derivative.worst_frame - 1),
            *std::ranges::max_element(t.derivative.series));
  ASSERT_TRUE(t.derivative.ci95);
  EXPECT_TRUE(t.derivative.ci95->contains(t.derivative.value));
  EXPECT_EQ(t.derivative.formula, "flicker-derivative-mean-reference");
  ASSERT_TRUE(t.still);
  EXPECT_EQ(t.still->series.size(), 3u);
  EXPECT_GT(t.still->value, 0);
  ASSERT_TRUE(t.still->ci95);
  EXPECT_TRUE(t.still->ci95->contains(t.still->value));
  ASSERT_TRUE(t.detail);
  ASSERT_EQ(t.derivative.values.size(), 4u);
  EXPECT_NEAR(std::accumulate(t.derivative.values.begin(), t.derivative.values.end(), 0.0) / 4,
              t.derivative.value, 1e-12);
  EXPECT_EQ(t.detail->values.size(), 4u);
  EXPECT_EQ(t.still->values.size(), 3u);
  for (const char* picture : {"flicker", "profile"}) {
    const Bitmap drawn = read_png(out_ / cases[0].images.at(picture));
    EXPECT_GT(drawn.width, 64u) << picture;
  }
  for (const char* folder : {"frames", "reference_frames"})
    EXPECT_TRUE(fs::exists(out_ / cases[0].images.at(folder) / "0004.exr")) << folder;
  // Every image says what it shows.
  const auto frame = read_exr_layers(out_ / cases[0].images.at("frames") / "0004.exr").attributes;
  const auto first = read_exr_layers(out_ / cases[0].images.at("frames") / "0000.exr").attributes;
  EXPECT_EQ(frame.at("case"), cases[0].id);
  EXPECT_EQ(frame.at("frame"), "4");
  EXPECT_NE(frame.at("sceneHash"), first.at("sceneHash"));
  EXPECT_TRUE(contains(frame.at("A"), "counts"));
  EXPECT_TRUE(read_exr_layers(out_ / cases[0].images.at("reference_frames") / "0004.exr")
                  .attributes.contains("reference"));
  for (const char* picture : {"flicker", "profile"})
    EXPECT_EQ(png_labels(read_text(out_ / cases[0].images.at(picture))).at("case"), cases[0].id) << picture;
}

TEST_F(MotionTest, FramesAreExported) {
  use(ring_scene(3));
  const CaseResult c = run().at(0);
  const fs::path to = folder_ / "exported";
  const ExportedFrames done = export_frames(out_, c, 2, to, "standard_4k");
  EXPECT_EQ(done.frames, 3u);
  EXPECT_EQ(done.rate, 4);
  EXPECT_EQ(done.peak, 0.5f);
  for (const char* side : {"test", "reference"})
    for (const char* file : {"0000.png", "0002.png", "0000.exr", "0002.exr"})
      EXPECT_TRUE(fs::exists(to / side / file)) << side << file;
  EXPECT_EQ(read_text(to / "test" / "0001.exr"), read_text(out_ / c.images.at("frames") / "0001.exr"));
  EXPECT_TRUE(contains(done.command, "--fps 4 --display standard_4k"));
  config_.erase("motion");
  EXPECT_THROW(export_frames(out_, run().at(0), 2, to, "standard_4k"), Error);
}

// By the frames on the disk, and the references anew of another seed: an image that is as good as the
// reference flickers as much as the floor says, and a black one as `unlit` says.
TEST_F(MotionTest, TheFloorIsWhatAPerfectImageHas) {
  use(ring_scene(4));
  const auto references = [&](int seed) {
    config_["reference"]["seed"] = seed;
    const CaseResult c = run().at(0);
    std::vector<MotionFrame> frames;
    for (uint32_t t = 0; t < 4; ++t)
      frames.push_back(read_motion_frame(out_ / c.images.at("reference_frames"), t));
    return std::pair(*c.temporal, frames);
  };
  const auto [here, frames] = references(1);
  const auto [there, others] = references(2);
  DerivativeFlickerMeter perfect, black;
  for (uint32_t t = 0; t < 4; ++t) {
    // Two images that are equally noisy differ by √2 times the noise of one.
    perfect.add(others[t].image, frames[t].image, frames[t].mask);
    black.add(Image(frames[t].image.width, frames[t].image.height), frames[t].image, frames[t].mask);
  }
  EXPECT_GT(here.noise_floor, 0);
  EXPECT_NEAR(perfect.finish()->value / std::sqrt(2.0), here.noise_floor, 0.15 * here.noise_floor);
  EXPECT_NEAR(here.unlit, black.finish()->value, 1e-6 * here.unlit);
}

// What an earlier export or run left, and nothing else, goes.
TEST_F(MotionTest, NoFrameOfAnEarlierExportStays) {
  use(ring_scene(4));
  const fs::path to = folder_ / "exported";
  export_frames(out_, run().at(0), 2, to, "standard_4k");
  write_text(to / "test" / "notes.txt", "mine");
  write_text(to / "test" / "12.exr", "mine");
  config_["motion"]["frames"] = 2;
  const CaseResult c = run().at(0);
  for (const char* folder : {"frames", "reference_frames"}) {
    EXPECT_TRUE(fs::exists(out_ / c.images.at(folder) / "0001.exr")) << folder;
    EXPECT_FALSE(fs::exists(out_ / c.images.at(folder) / "0002.exr")) << folder;
  }
  EXPECT_EQ(export_frames(out_, c, 2, to, "standard_4k").frames, 2u);
  for (const char* side : {"test", "reference"}) {
    for (const char* file : {"0002.png", "0003.exr"})
      EXPECT_FALSE(fs::exists(to / side / file)) << side << file;
    EXPECT_TRUE(fs::exists(to / side / "0001.png"));
  }
  EXPECT_EQ(read_text(to / "test" / "notes.txt") + read_text(to / "test" / "12.exr"), "minemine");
}

TEST_F(MotionTest, WhatIsNoFrameIsNotExported) {
  use(ring_scene(3));
  const CaseResult c = run().at(0);
  const fs::path from = out_ / c.images.at("frames"), to = folder_ / "exported";
  const auto problem = [&](const CaseResult& asked) {
    try {
      export_frames(out_, asked, 2, to, "standard_4k");
    } catch (const Error& e) {
      EXPECT_EQ(e.exit_code(), 2);
      return std::string(e.what());
    }
    return std::string();
  };
  CaseResult none = c;
  none.temporal->frames = 0;
  EXPECT_TRUE(contains(problem(none), "has 0 frames"));
  fs::remove(from / "0001.exr");
  ASSERT_EQ(::mkfifo((from / "0001.exr").c_str(), 0600), 0);
  EXPECT_TRUE(contains(problem(c), "0001.exr: is no plain file"));
  fs::remove(from / "0001.exr");
  ExrLayers other{8, 4, {{"", Image(8, 4)}}, {}, {{"frames_per_second", "4"}}};
  other.scalars["A"] = std::vector<float>(32, 1);
  write_exr(from / "0001.exr", other);
  EXPECT_TRUE(contains(problem(c), "0001.exr: has 8x4 pixels but the first frame "));
  fs::remove_all(to);
  write_text(to, "a file");
  EXPECT_TRUE(contains(problem(c), "exported/test: can't be made"));
}

TEST_F(MotionTest, ARateThatNoPictureHoldsCostsNoCase) {
  Json scene = ring_scene(3);
  scene["animation"]["rate"] = 5e4;
  use(scene);
  const CaseResult c = run().at(0);
  EXPECT_EQ(c.status, Status::ok);
  EXPECT_TRUE(fs::exists(out_ / c.images.at("flicker")));
}

// The frames on the disk are those that were measured; a flicker that is planted in one of them is found
// there and in the next, which goes back, and nowhere else.
TEST_F(MotionTest, APlantedFlickerIsFoundInItsFrame) {
  for (const bool moves : {true, false}) {
    use(ring_scene(6, moves));
    config_["motion"]["seeds"] = 1;
    const CaseResult c = run().at(0);
    const auto flicker = [&](float planted) {
      DerivativeFlickerMeter meter;
      for (uint32_t t = 0; t < 6; ++t) {
        MotionFrame x = read_motion_frame(out_ / c.images.at("frames"), t);
        if (t == 3)
          for (glm::vec3& p : x.image.pixels) p *= planted;
        meter.add(x.image, read_motion_frame(out_ / c.images.at("reference_frames"), t).image, x.mask);
      }
      return meter.finish().value();
    };
    const DerivativeFlicker as_it_was = flicker(1), planted = flicker(1.2f);
    EXPECT_EQ(as_it_was.series, c.temporal->derivative.series);
    for (const size_t i : {0u, 1u, 4u}) EXPECT_EQ(planted.series[i], as_it_was.series[i]);
    for (const size_t i : {2u, 3u}) EXPECT_NE(planted.series[i], as_it_was.series[i]);
    if (moves) continue;
    EXPECT_EQ(planted.series[2], planted.series[3]);
    EXPECT_GT(planted.series[2], 0.05);
    EXPECT_EQ(planted.worst_frame, 3u);
  }
}

// The scene's light has a fifth more power in frame 3 and a fifth less in frame 5, which its reference has
// not: each change and each return is found in its frame, and is a fifth of the image's light.
TEST_F(MotionTest, AFlickeringLightIsFoundInItsFrames) {
  constexpr uint32_t kFrames = 8;
  config_["motion"]["seeds"] = 1;
  const auto frames_of = [&](bool flickers, const char* folder) {
    Json scene = ring_scene(kFrames, false);
    Json keys = Json::array();
    for (uint32_t t = 0; t < kFrames; ++t) {
      const double power = !flickers ? 1 : t == 3 ? 1.2 : t == 5 ? 0.8 : 1;
      keys.push_back({{"time", t / 4.0}, {"intensity", 10 * power}});
    }
    Json& spot = scene["views"]["front"]["light"]["spot"];
    spot["interpolation"] = "step";
    spot["keys"] = keys;
    use(scene);
    const CaseResult c = run().at(0);
    std::vector<MotionFrame> frames;
    for (uint32_t t = 0; t < kFrames; ++t) frames.push_back(read_motion_frame(out_ / c.images.at(folder), t));
    return frames;
  };
  const auto x = frames_of(true, "frames"), r = frames_of(false, "reference_frames");
  DerivativeFlickerMeter meter;
  double light = 0, reference = 0;
  for (uint32_t t = 0; t < kFrames; ++t) {
    meter.add(x[t].image, r[t].image, x[t].mask);
    for (size_t i = 0; i < x[0].image.pixels.size(); ++i) {
      if (x[0].mask[i] == 0) continue;
      light += x[0].image.pixels[i].x + x[0].image.pixels[i].y + x[0].image.pixels[i].z;
      reference += r[0].image.pixels[i].x + r[0].image.pixels[i].y + r[0].image.pixels[i].z;
    }
  }
  const std::vector<double> series = meter.finish()->series;
  for (uint32_t t = 1; t < kFrames; ++t) {
    const bool planted = t >= 3 && t <= 6;  // brighter, back, darker, back
    EXPECT_NEAR(series[t - 1], planted ? 0.2 * light / reference : 0, 1e-3 * light / reference)
        << "frame " << t;
  }
}

TEST_F(MotionTest, WhatHangsStillDoesNotFlicker) {
  use(ring_scene(4, false));
  config_["motion"]["frames"] = 3;
  const Temporal t = run().at(0).temporal.value();
  EXPECT_EQ(t.derivative.value, 0);
  EXPECT_EQ(t.derivative.p99, 0);
  EXPECT_EQ(t.derivative.series, std::vector<double>(2, 0.0));
  EXPECT_EQ(t.references, std::vector<std::string>(3, t.references.front()));
  ASSERT_TRUE(t.still);
  EXPECT_GT(t.still->value, 0);
}

// A lattice that is shifted shimmers, though nothing moves.
TEST_F(MotionTest, AShiftedLatticeFlickers) {
  use(ring_scene(3, false));
  config_["methods"][0]["lattice"] = {"fixed", "shifted"};
  const std::vector<CaseResult> cases = run();
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_TRUE(contains(cases[1].id, "lattice=shifted"));
  EXPECT_EQ(cases[0].temporal->derivative.value, 0);
  EXPECT_GT(cases[1].temporal->derivative.value, 0.01);
  EXPECT_EQ(cases[0].temporal->still->value, cases[1].temporal->still->value);
}

// Chains that go on are drawn anew in every frame, with a state for each seed; frame 0 and what is compared
// are those of fresh ones. One seed is the same whatever others there are.
TEST_F(MotionTest, CarriedChainsGoOnFromFrameToFrame) {
  use(ring_scene(3, false));
  config_["methods"] = {{{"method", "mfis-mh"}, {"steps", 4}, {"chains", {"fresh", "carried"}}}};
  const std::vector<CaseResult> cases = run();
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].temporal->derivative.value, 0);
  EXPECT_GT(cases[1].temporal->derivative.value, 0);
  EXPECT_EQ(cases[0].temporal->still->value, cases[1].temporal->still->value);
  EXPECT_EQ(part_to_json(cases[0])["accuracy"], part_to_json(cases[1])["accuracy"]);
  const auto last = [&] { return read_motion_frame(out_ / cases[1].images.at("frames"), 2).image.pixels; };
  const auto with_others = last();
  config_["motion"]["seeds"] = 1;
  EXPECT_EQ(run().size(), 2u);
  EXPECT_TRUE(last() == with_others);
}

// What is timed afterwards, and compared, is frame 0.
TEST_F(MotionTest, ErrorsAreThoseOfTheFirstFrame) {
  use(ring_scene(4));
  const CaseResult moving = run().at(0);
  config_.erase("motion");
  const CaseResult first = run().at(0);
  EXPECT_FALSE(first.temporal);
  EXPECT_EQ(part_to_json(moving)["accuracy"], part_to_json(first)["accuracy"]);
}

TEST_F(MotionTest, OfAStillSceneThereIsAWarning) {
  config_["methods"] = {{{"method", "mfis"}}};
  ::testing::internal::CaptureStderr();
  EXPECT_FALSE(run().at(0).temporal);
  EXPECT_TRUE(
      contains(::testing::internal::GetCapturedStderr(), "cornell: stands still: no flicker is measured"));
}

TEST_F(MotionTest, WithoutOcclusionTheReferencesAreOthers) {
  use(ring_scene(3));
  config_["visibility"] = {"exact", "none"};
  const std::vector<CaseResult> cases = run();
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_NE(cases[0].temporal->references, cases[1].temporal->references);
  EXPECT_NE(cases[0].images.at("reference_frames"), cases[1].images.at("reference_frames"));
}

// Killed while it times, a run has its flicker; killed amid the frames, it measures them again.
TEST_F(MotionTest, AKilledRunGoesOn) {
  use(ring_scene(3));
  const Json whole = part_to_json(run().at(0))["temporal"];
  kill_at("frame 2");
  EXPECT_TRUE(contains(read_text(out_ / "report.journal"), "temporal"));
  EXPECT_EQ(part_to_json(run().at(0))["temporal"], whole);
  kill_at("frame 1 in motion, seed 0");
  EXPECT_FALSE(read_text(out_ / "report.journal").find("temporal") != std::string::npos);
  EXPECT_EQ(part_to_json(run().at(0))["temporal"], whole);
}

}  // namespace
}  // namespace vsglbench
