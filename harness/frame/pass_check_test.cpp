// The health gate: what went bad first is named, whatever became of it; what is sound raises no alarm.
#include "frame/pass_check.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"
#include "base/file.h"
#include "frame/frame.h"
#include "method/light_kernel.h"
#include "method/registry.h"
#include "scene/scene_file.h"

namespace vsglbench {
namespace {

constexpr uint32_t kNan = 0x7FC00000u, kInf = 0x7F800000u;

Device& device() {
  static Device d;
  return d;
}

std::filesystem::path test_kernel() { return data_root() / "harness" / "frame" / "pass_check_test.comp"; }

TEST(Reflection, FindsTheFloatsOfWhatAKernelMayWrite) {
  const FloatOutputs outputs = reflect_float_outputs(compile_shader(test_kernel(), {}, {}));
  EXPECT_FALSE(outputs.uses_infinity);
  ASSERT_EQ(outputs.arrays.size(), 2u);  // not `from`, which is readonly, nor `head`, a uint
  EXPECT_EQ(outputs.arrays[0].name, "total");
  EXPECT_EQ(outputs.arrays[0].offset, 4u);
  EXPECT_EQ(outputs.arrays[0].count, 1u);
  const FloatArray& to = outputs.arrays[1];
  EXPECT_EQ(to.name, "to");
  EXPECT_EQ(to.binding, 1u);
  EXPECT_EQ(to.offset, 8u);
  EXPECT_EQ(to.stride, 20u);
  EXPECT_EQ(to.count, 0u);
  const std::vector<std::pair<std::string, uint32_t>> fields = {
      {"mean.x", 4}, {"mean.y", 8}, {"mean.z", 12}, {"power", 16}};
  ASSERT_EQ(to.fields.size(), fields.size());
  for (size_t i = 0; i < fields.size(); ++i) {
    EXPECT_EQ(to.fields[i].name, fields[i].first);
    EXPECT_EQ(to.fields[i].offset, fields[i].second);
  }
  EXPECT_TRUE(reflect_float_outputs(compile_shader(test_kernel(), {{"SENTINEL", "1"}}, {})).uses_infinity);
}

// --- passes of the test kernel ---

class PassCheckTest : public ::testing::Test {
 protected:
  static constexpr uint32_t kCount = 21;  // a pyramid over 4 x 4 texels
  struct Push {
    uint32_t count, at, bad;
  };
  static constexpr Push kSound{kCount, kCount, 0};

  PassCheckTest() {
    const std::vector<float> sound(kCount, 1);
    from_.upload(std::span<const float>(sound));
    FrameOutputs outputs;
    outputs.buffer = [this](const PassId&, const Buffer& b) {
      return FrameOutputs::NamedBuffer{&b == &to_ ? "moments" : "", b.size()};
    };
    outputs.half = [this](const PassId&) { return FrameOutputs::HalfSize{{4, 4}, lights_}; };
    outputs.targets = [](const PassId&) { return nullptr; };
    check_.emplace(std::move(outputs));
    recorder_.observe(&*check_);
  }
  void pass(const std::string& name, const Kernel& kernel, const Push& push) {
    recorder_.pass({.step = name}, [&] { recorder_.dispatch(kernel, {from_, to_}, push, 1); });
  }
  // One frame: a pass that goes bad, and one after it that makes all well again.
  std::string found(const Kernel& kernel, const Push& push) {
    check_->restart();
    recorder_.begin();
    pass("first", kernel, kSound);
    pass("second", kernel, push);
    pass("third", kernel, kSound);
    const SubmissionTimes times = recorder_.submit_and_wait();
    EXPECT_EQ(times.passes.size(), 3u);
    EXPECT_EQ(times.dispatches, 3u);
    return check_->first_bad() ? check_->first_bad()->message() : "";
  }

  uint64_t lights_ = 0;
  Buffer from_{device(), "from", kCount * sizeof(float)}, to_{device(), "to", 8 + kCount * 20};
  Kernel kernel_{device(), test_kernel(), {}, {}},
      sentinel_{device(), test_kernel(), {{"SENTINEL", "1"}}, {}};
  Recorder recorder_{device()};
  std::optional<PassCheck> check_;
};

TEST_F(PassCheckTest, NamesPassElementAndTexelOfWhatIsGoneAtTheEnd) {
  EXPECT_EQ(
      found(kernel_, {kCount, 18, kNan}),
      "pass second is the first to hold a NaN: buffer moments, element 18 (mean.y), texel (0, 1) of level 1");
  EXPECT_EQ(check_->first_bad()->nan, 1u);
  EXPECT_EQ(
      found(kernel_, {kCount, 7, kInf}),
      "pass second is the first to hold an Inf: buffer moments, element 7 (mean.y), texel (3, 1) of level 0");
  EXPECT_EQ(check_->first_bad()->inf, 1u);
  lights_ = kCount;  // then an element is a light, not a texel
  EXPECT_EQ(found(kernel_, {kCount, 7, kNan}),
            "pass second is the first to hold a NaN: buffer moments, element 7 (mean.y)");
}

// Though `bits` and `head` are NaNs to who takes them for floats.
TEST_F(PassCheckTest, SoundPassesRaiseNoAlarm) { EXPECT_EQ(found(kernel_, kSound), ""); }

TEST_F(PassCheckTest, InfIsAValueOfAKernelThatNamesIt) {
  EXPECT_EQ(found(sentinel_, {kCount, 7, kInf}), "");
  EXPECT_NE(found(sentinel_, {kCount, 7, kNan}), "");
}

// A buffer is larger than what the pass writes; the rest is an earlier case's.
TEST_F(PassCheckTest, NobodyIsBlamedForWhatWasThereBefore) {
  const std::vector<uint32_t> stale(to_.size() / 4, kNan);
  to_.upload(std::span<const uint32_t>(stale));
  EXPECT_EQ(found(kernel_, {kCount / 2, kCount, 0}), "");
  // Within a frame it is somebody's.
  check_->restart();
  recorder_.begin();
  pass("first", kernel_, {kCount, 20, kNan});
  EXPECT_EQ(check_->first_bad()->pass.name(), "first");
  recorder_.submit_and_wait();
}

TEST_F(PassCheckTest, WithoutItPassesGoTogether) {
  recorder_.observe(nullptr);
  check_->restart();
  recorder_.begin();
  pass("first", kernel_, {kCount, 3, kNan});
  pass("second", kernel_, kSound);
  EXPECT_EQ(recorder_.submit_and_wait().passes.size(), 2u);
  EXPECT_FALSE(check_->first_bad());
}

// --- whole frames ---

struct Session {
  explicit Session(const Scene& s) : kernels(device()), stage(device(), kernels, s) {}
  std::unique_ptr<Frame> frame(const MethodInfo& info, FrameParameters p, const Json& own = Json::object()) {
    const uint64_t pixels = uint64_t(p.width) * p.height;
    return std::make_unique<Frame>(
        stage, info, resolve_parameters(info, own), p, [pixels](const auto& lights) {
          return std::vector<uint32_t>(lights.size() * groups_for(pixels, 32), ~0u);
        });
  }
  KernelLibrary kernels;
  Stage stage;
};

Scene cornell() { return load_scene("cornell", {data_root() / "scenes", {}}); }

FrameParameters checked() {
  return {.width = 40,
          .height = 30,
          .rsm = 32,
          .lights = 24,
          .importance_lights = 32,
          .visibility = Visibility::none,
          .check_passes = true};
}

std::string found(Frame& frame) {
  frame.render(1);
  return frame.bad_output() ? frame.bad_output()->message() : "";
}

TEST(PassCheckFrame, EveryMethodIsSoundOverEveryVisibility) {
  const Scene scene = cornell();
  Session session(scene);
  for (const MethodInfo* method : all_methods()) {
    const MethodInfo& info = load_method(method->name, device().info());
    for (const Visibility v :
         {Visibility::none, Visibility::exact, Visibility::ism, Visibility::aism, Visibility::tism}) {
      FrameParameters p = checked();
      p.visibility = v;
      EXPECT_EQ(found(*session.frame(info, p)), "") << method->name << " " << visibility_name(v);
    }
  }
}

// With as many lights as texels k-means has centres on one another: the kd-tree puts them at infinity.
TEST(PassCheckFrame, EveryMethodIsSoundWithALightATexel) {
  const Scene scene = cornell();
  Session session(scene);
  for (const MethodInfo* method : all_methods()) {
    FrameParameters p = checked();
    p.rsm = 8;
    p.lights = 64;
    EXPECT_EQ(found(*session.frame(load_method(method->name, device().info()), p)), "") << method->name;
  }
}

TEST(PassCheckFrame, EveryWayToShadeAndWeighIsSound) {
  const Scene scene = cornell();
  Session session(scene);
  const MethodInfo& mfis = load_method("mfis", device().info());
  for (const Importance importance : {Importance::own, Importance::vsgl, Importance::vpl, Importance::flux}) {
    FrameParameters p = checked();
    p.importance = importance;
    p.bias_reduction = 0.5f;
    p.progressive = 2;
    EXPECT_EQ(found(*session.frame(mfis, p)), "");
  }
}

TEST(PassCheckFrame, ImageAndTimesAreThoseOfAnOrdinaryFrame) {
  const Scene scene = cornell();
  Session session(scene);
  FrameParameters p = checked();
  p.visibility = Visibility::exact;
  for (const char* method : {"mfis", "kmeans2d"}) {
    p.check_passes = true;
    const auto alone = session.frame(load_method(method, device().info()), p);
    const FrameTimes a = alone->render(1);
    p.check_passes = false;
    const auto together = session.frame(load_method(method, device().info()), p);
    const FrameTimes b = together->render(1);
    EXPECT_TRUE(alone->results().indirect().pixels == together->results().indirect().pixels) << method;
    ASSERT_EQ(a.passes.size(), b.passes.size());
    for (size_t i = 0; i < a.passes.size(); ++i) EXPECT_EQ(a.passes[i].pass, b.passes[i].pass);
    EXPECT_EQ(a.generate_dispatches, b.generate_dispatches);
    EXPECT_LE(a.sum_ms, 1.0001 * a.span_ms);
    EXPECT_FALSE(together->bad_output());
  }
}

// Weighs every texel, one of them with a NaN, and forgets about it: sound lights, a sound image.
class HidesNan : public Method {
 public:
  explicit HidesNan(MethodContext& context)
      : context_(context),
        weigh_(context.shared_kernel("../../frame/pass_check_test.comp")),
        lights_(make_light_kernel(context, "vpl.comp", LightKind::vpl)) {}
  LightKind kind() const override { return lights_->kind(); }
  void generate(Steps& steps, const Field& field, const LightTarget& target) override {
    const auto texels = static_cast<uint32_t>(field.texels());
    Buffer& weights = context_.scratch(fmt::format("weights.{}", half_name(field.half)), 8 + texels * 20);
    const auto weigh = [&](uint32_t at) {
      const struct { uint32_t count, at, bad; } push{texels, at, kNan};
      steps.recorder().dispatch(weigh_, {*field.pdf, weights}, push, groups_for(texels, 64));
    };
    steps.pass("weigh", [&] { weigh(field.half == Half::rsm ? 3 * field.emitter.width + 5 : texels); });
    steps.pass("clean", [&] { weigh(texels); });
    lights_->generate(steps, field, target);
  }

 private:
  MethodContext& context_;
  const Kernel& weigh_;
  std::unique_ptr<Method> lights_;
};

TEST(PassCheckFrame, ANanThatIsGoneByTheEndIsNamedByPassAndTexel) {
  const Scene scene = cornell();
  Session session(scene);
  MethodInfo info{.create = [](MethodContext& context, const Json&) -> std::unique_ptr<Method> {
    return std::make_unique<HidesNan>(context);
  }};
  info.name = "hides-nan";
  info.folder = find_method("vpl").folder;
  FrameParameters p = checked();
  EXPECT_EQ(found(*session.frame(info, p)),
            "pass generate.rsm.weigh is the first to hold a NaN: buffer weights.rsm, element 101 (mean.y), "
            "texel (5, 3)");
  p.check_passes = false;
  const auto ordinary = session.frame(info, p);
  EXPECT_EQ(found(*ordinary), "");
  EXPECT_FALSE(ordinary->results().first_bad_pass());
  EXPECT_FALSE(ordinary->results().bad_values());
}

// Lights whose flux is no number, and walls whose colour is none.
TEST(PassCheckFrame, NamesALightAndATexelOfARasterPass) {
  Scene scene = cornell();
  {
    Session session(scene);
    MethodInfo info{.create = [](MethodContext& context, const Json&) {
      return make_light_kernel(context, "returns_nan.comp", LightKind::vsgl);
    }};
    info.name = "returns-nan";
    info.folder = data_root() / "harness" / "cli" / "bad_plugins";
    const auto frame = session.frame(info, checked());
    frame->render(0);
    ASSERT_TRUE(frame->bad_output());
    EXPECT_TRUE(frame->bad_output()->is_light);
    EXPECT_EQ(frame->bad_output()->message(),
              fmt::format(
                  "pass generate.gbuffer.sample is the first to hold a NaN: buffer lights.gbuffer, light {} "
                  "(diffuse.x)",
                  frame->bad_output()->element));
  }
  for (auto& material : scene.materials) material.base_color.x = std::numeric_limits<float>::quiet_NaN();
  Session session(scene);
  const auto frame = session.frame(load_method("mfis", device().info()), checked());
  frame->render(0);
  ASSERT_TRUE(frame->bad_output());
  EXPECT_EQ(frame->bad_output()->pass.name(), "gbuffer");
  EXPECT_EQ(frame->bad_output()->buffer, "gbuffer diffuse");
  EXPECT_EQ(frame->bad_output()->field, "x");
  EXPECT_TRUE(frame->bad_output()->texel);
}

}  // namespace
}  // namespace vsglbench
