// Whole frames: energy, repeatability, odd sizes, and silence of the validation layers.
#include "frame/frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include <numeric>

#include "base/error.h"
#include "base/file.h"
#include "method/registry.h"
#include "scene/scene_file.h"

using namespace vsglbench;

namespace {

Scene load(const std::string& name) { return load_scene(name, {data_root() / "scenes", {}}); }

Device& device() {
  static Device d;
  return d;
}

// All pixels see all lights.
std::vector<uint32_t> all_visible(size_t lights, uint64_t pixels) {
  return std::vector<uint32_t>(lights * groups_for(pixels, 32), ~0u);
}

struct Session {
  explicit Session(const Scene& s, Device& d = device()) : kernels(d), stage(d, kernels, s) {}
  std::unique_ptr<Frame> frame(const std::string& method, const FrameParameters& p,
                               const Json& own = Json::object()) {
    const MethodInfo& info = load_method(method, kernels.device().info());
    const uint64_t pixels = uint64_t(p.width) * p.height;
    return std::make_unique<Frame>(
        stage, info, resolve_parameters(info, own), p,
        [pixels](const auto& lights) { return all_visible(lights.size(), pixels); });
  }
  KernelLibrary kernels;
  Stage stage;
};

FrameParameters small(Visibility visibility = Visibility::none) {
  return {
      .width = 64, .height = 36, .rsm = 64, .lights = 64, .importance_lights = 64, .visibility = visibility};
}

double flux_ratio(const Scene& scene) {
  Session session(scene);
  FrameParameters p = small();
  p.width = p.height = 8;
  p.rsm = 256;
  auto frame = session.frame("all-texels", p);
  frame->render(0);
  glm::dvec3 sum(0);
  for (const auto& light : frame->results().lights().all<gpu::Vpl>()) sum += glm::dvec3(light.flux);
  return sum.x / frustum_flux(scene.light).x;
}

}  // namespace

// Σ texel flux = the light's flux inside its frustum, where every texel sees a surface [light-transport §1].
TEST(Frame, TexelFluxAddsUpToTheLights) {
  Scene spot = load("cornell");
  spot.light.fov = 0.8f;  // narrow enough that no ray leaves through the open front
  EXPECT_NEAR(flux_ratio(spot), 1, 1e-3);
  Scene sun = load("cornell");
  sun.light.type = Light::Type::directional;
  sun.light.half_extent = {0.3f, 0.2f};
  EXPECT_NEAR(flux_ratio(sun), 1, 1e-3);
}

TEST(Frame, TheSameSeedGivesTheSameBits) {
  const Scene scene = load("cornell");
  Session session(scene);
  for (const char* method : {"vpl", "fis", "mfis"}) {
    auto frame = session.frame(method, small());
    frame->render(3);
    const Image a = frame->results().indirect();
    frame->render(4);
    const Image other = frame->results().indirect();
    frame->render(3);
    const Image b = frame->results().indirect();
    EXPECT_TRUE(a.pixels == b.pixels) << method;
    EXPECT_FALSE(a.pixels == other.pixels) << method << ": the seed changes nothing";
  }
}

// On PDFs of its own making a method makes the lights that it makes in a whole frame, whatever other frames
// have rendered since; nothing but its generate passes runs.
TEST(Frame, GenerationAloneGivesTheLightsOfTheWholeFrame) {
  const Scene scene = load("cornell");
  Session session(scene);
  for (const char* method : {"vpl", "fis", "mfis"}) {
    auto whole = session.frame(method, small());
    whole->render(3);
    const LightRecords expected = whole->results().lights();
    ASSERT_LT(count_without_power(expected), expected.count());
    const KeptPdfs pdfs = session.frame(method, small())->prepare(3);
    FrameParameters other = small();
    other.importance_lights = 3;
    session.frame("fis", other)->render(1);  // overwrites the scratch memory with another PDF and lights
    auto alone = session.frame(method, small());
    const FrameTimes times = alone->generate_only(3, pdfs);
    EXPECT_TRUE(alone->results().lights() == expected) << method;
    for (const auto& [pass, ms] : times.passes) EXPECT_EQ(pass.stage, PassStage::generate) << pass.name();
    EXPECT_EQ(times.generate_dispatches, whole->render(3).generate_dispatches);
    EXPECT_GT(times.span_ms, 0);
    EXPECT_FALSE(alone->results().bad_values());
  }
  EXPECT_THROW(session.frame("all-texels", small())->prepare(0), Error);
}

TEST(Frame, TheFirstBadLightIsNamed) {
  const Scene scene = load("cornell");
  Session session(scene);
  auto frame = session.frame("mfis", small());
  frame->generate_only(0, frame->prepare(0));
  EXPECT_FALSE(frame->results().bad_values());
  const auto spoil = [&](Half half, size_t light, float value) {
    const size_t bytes = 64 * sizeof(gpu::Vsgl);
    session.stage.memory.lights[static_cast<size_t>(half)]
        .at(bytes)
        .get(device(), "lights", bytes)
        .upload(&value, sizeof value, light * sizeof(gpu::Vsgl) + offsetof(gpu::Vsgl, power));
  };
  spoil(Half::rsm, 9, std::nanf(""));
  spoil(Half::rsm, 5, INFINITY);
  ASSERT_TRUE(frame->results().bad_values());
  EXPECT_EQ(frame->results().bad_values()->message(),
            "1 lights with a NaN and 1 with an Inf, the first is light 5 of generate.rsm");
  spoil(Half::gbuffer, 7, std::nanf(""));
  EXPECT_EQ(frame->results().bad_values()->message(),
            "2 lights with a NaN and 1 with an Inf, the first is light 7 of generate.gbuffer");
}

TEST(Frame, NamesItsPassesInOrder) {
  const Scene scene = load("cornell");
  Session session(scene);
  std::vector<std::string> names;
  for (const auto& [pass, ms] : session.frame("mfis", small(Visibility::ism))->render(0).passes)
    names.push_back(pass.name());
  const std::vector<std::string> expected = {"gbuffer",
                                             "rsm",
                                             "importance.gbuffer",
                                             "generate.gbuffer.resolve",
                                             "generate.gbuffer.mipmap",
                                             "generate.gbuffer.sample",
                                             "importance.rsm",
                                             "generate.rsm.resolve",
                                             "generate.rsm.mipmap",
                                             "generate.rsm.sample",
                                             "visibility.ism.splat",
                                             "visibility.ism.pull",
                                             "visibility.ism.push",
                                             "shade"};
  EXPECT_EQ(names, expected);
}

struct TimesOfOneFrame {
  double shade_ms, sum_ms, span_ms;
};

// Of the frame with the median span of three.
TimesOfOneFrame typical_times(Session& session, uint32_t lights) {
  FrameParameters p = small();
  p.width = 128;
  p.height = 72;
  p.lights = lights;
  auto frame = session.frame("mfis", p);
  frame->render(0);
  std::vector<TimesOfOneFrame> all;
  for (int i = 0; i < 3; ++i) {
    const FrameTimes times = frame->render(0);
    const auto shade = std::ranges::find(times.passes, PassId{.stage = PassStage::shade}, &PassTime::pass);
    all.push_back({shade->ms, times.sum_ms, times.span_ms});
  }
  std::ranges::nth_element(all, all.begin() + 1, {}, &TimesOfOneFrame::span_ms);
  return all[1];
}

// Passes follow each other, so their sum is no more than the span; and a pass's time covers its work, so what
// a frame takes longer for 16 times the lights, which are nearly all shading, is in the sum and in that pass,
// not between two passes: on lavapipe a timestamp without a barrier of its own misses it. What share of a
// frame that is, is the device's affair.
TEST(Frame, PassTimesAddUpToTheSpan) {
  const Scene scene = load("cornell");
  Session session(scene);
  const TimesOfOneFrame few = typical_times(session, 64), many = typical_times(session, 1024);
  for (const TimesOfOneFrame& t : {few, many}) EXPECT_LE(t.sum_ms, 1.0001 * t.span_ms);
  EXPECT_GT(many.span_ms, few.span_ms);
  EXPECT_GT(many.sum_ms - few.sum_ms, 0.9 * (many.span_ms - few.span_ms));
  EXPECT_GT(many.shade_ms - few.shade_ms, 0.5 * (many.span_ms - few.span_ms));
}

TEST(Frame, OddSizesWork) {
  const Scene scene = load("cornell");
  Session session(scene);
  for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(7, 5), glm::uvec2(65, 33)}) {
    for (const char* method : {"vpl", "fis", "mfis", "all-texels"}) {
      FrameParameters p = small(Visibility::exact);
      p.width = size.x;
      p.height = size.y;
      p.rsm = size.x;
      p.lights = 1;
      auto frame = session.frame(method, p);
      frame->render(0);
      EXPECT_FALSE(frame->results().first_bad_pass()) << method << " " << size.x << "x" << size.y;
    }
  }
}

// The bit matrix split over several dispatches gives what one dispatch gives.
TEST(Frame, ManyLightsAreShadedInChunks) {
  const Scene scene = load("cornell");
  Session session(scene);
  FrameParameters p = small(Visibility::none);
  p.width = 16;
  p.height = 9;
  p.rsm = 200;  // 40,000 lights: three dispatches of at most 16,384
  auto whole = session.frame("all-texels", p);
  whole->render(0);
  const Image a = whole->results().indirect();
  p.visibility = Visibility::exact;
  auto chunks = session.frame("all-texels", p);
  chunks->render(0);
  const Image b = chunks->results().indirect();
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    EXPECT_NEAR(luminance(a.pixels[i]), luminance(b.pixels[i]), 1e-5f * luminance(a.pixels[i]) + 1e-12f);
  }
}

TEST(Frame, RefusesSizesThatMakeNoSense) {
  const Scene scene = load("cornell");
  Session session(scene);
  FrameParameters p = small();
  p.lights = 0;
  EXPECT_THROW(session.frame("mfis", p), Error);
  p.lights = p.rsm * p.rsm + 1;
  EXPECT_THROW(session.frame("vpl", p), Error);
  p = small();
  p.width = 0;
  EXPECT_THROW(session.frame("fis", p), Error);
}

// lavapipe ends a shader's loops after 65535 rounds, without a word: 300² lights take several dispatches, and
// are as bright as 100² are.
TEST(Shade, EveryOneOfManyLightsCounts) {
  const Scene scene = load("cornell");
  Session session(scene);
  const auto mean = [&](uint32_t rsm, Visibility visibility) {
    auto frame =
        session.frame("all-texels", {.width = 16, .height = 9, .rsm = rsm, .visibility = visibility});
    frame->render(0);
    double sum = 0;
    for (const glm::vec3& p : frame->results().indirect().pixels) sum += p.x + p.y + p.z;
    return sum;
  };
  for (const Visibility v : {Visibility::none, Visibility::exact}) {
    EXPECT_NEAR(mean(300, v) / mean(100, v), 1, 0.01);
  }
}

// The same of the lights on the G-buffer, which the RSM's texels sum.
TEST(Importance, EveryOneOfManyLightsCounts) {
  const Scene scene = load("cornell");
  Session session(scene);
  const auto mean = [&](uint32_t lights) {
    auto frame = session.frame("mfis", {.width = 320,
                                        .height = 240,
                                        .rsm = 16,
                                        .lights = 16,
                                        .importance_lights = lights,
                                        .visibility = Visibility::none});
    frame->render(0);
    const auto p = frame->results().importance();
    return std::accumulate(p.begin(), p.end(), 0.0);
  };
  EXPECT_NEAR(mean(70000) / mean(10000), 1, 0.05);
}

// Zero messages, synchronisation checks included, over a frame of every method and visibility. The planted
// hazard shows that a message would be seen.
TEST(Validation, IsSilentOverEveryMethod) {
  Device checked({.validation = true});
  const Scene scene = load("cornell");
  {
    Session session(scene, checked);
    for (const MethodInfo* method : all_methods()) {
      for (const Visibility v :
           {Visibility::none, Visibility::exact, Visibility::ism, Visibility::aism, Visibility::tism}) {
        auto frame = session.frame(method->name, small(v));
        frame->render(0);
        frame->render_direct();
        frame->results().indirect();
      }
    }
  }
  for (const auto& message : checked.validation_messages()) ADD_FAILURE() << message;

  const size_t before = checked.validation_messages().size();
  KernelLibrary kernels(checked);
  const Kernel& pull = kernels.get(data_root() / "harness" / "frame" / "ism_pull.comp");
  Buffer a(checked, "a", 4096), b(checked, "b", 4096), c(checked, "c", 4096);
  Recorder recorder(checked);
  recorder.begin();
  recorder.pass({.step = "hazard"}, [&] {
    recorder.dispatch(pull, {a, b}, uint32_t{4}, 1);
    recorder.dispatch(pull, {b, c}, uint32_t{4}, 1);  // no barrier between writing b and reading it
  });
  recorder.submit_and_wait();
  EXPECT_GT(checked.validation_messages().size(), before) << "the layers don't report a missing barrier";
}
