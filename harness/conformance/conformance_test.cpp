// The conformance kit can fail: methods that each break one rule, and the kit names that rule and no other.
#include "conformance/conformance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "method/light_kernel.h"

using namespace vsglbench;

namespace {

// What the method under test does wrong, in the checking process. Each leaves all else as in `vpl`.
enum class Fault {
  none,
  nan_without_pdf,      // NaN in the place of no light
  nan_position,         // in every light
  compile_error,        // in its kernel
  undeclared,           // reads a parameter that it does not declare
  power_from_nothing,   // a light of power where there is no surface
  power_misstated,      // `power` is twice what the flux is
  flux_doubled,         // twice the flux, consistently
  seed_ignored,         // the same lights for every shift
  counts_frames,        // lights depend on how many frames there were
  trusts_scratch,       // expects scratch memory as its constructor left it
  leaks,                // a buffer that nothing frees
  grows,                // a buffer more every frame
  no_barrier,           // a dispatch reads the lights just written, without a barrier between
  past_lights,          // one light too many
  past_scratch,         // the same in a scratch buffer
  far_past_lights,      // the last light 4 MiB behind the lights
  far_past_scratch,     // the same in a scratch buffer
  unnamed_pass,         // a pass that is not one of Steps
  outside_pass,         // a dispatch in no pass
  passes_change,        // the first frame has one pass more
  gain_at_end,          // NaN where the parameter is at its maximum
  crashes_on_a_column,  // on 1×64
  hangs_on_a_row,       // on 64×1
  loses_device,         // on 1×64
  leaves,               // ends the process, on 1×64
};
Fault fault = Fault::none;  // of the method that the next check makes

constexpr char kKernel[] = R"(#version 460
#define LIGHT Vpl
#include "light_kernel.glsl"
Vpl make_light(uint i) {
  Draw d;
  Texel t;
  bool drawn = draw(i, d);
  bool surface = load_texel(emitter, ivec2(d.texel), t);
  float share = drawn && surface ? d.share : 0.0;
  Vpl v = make_vpl(t, share * parameter[0]);
  FAULT
  return v;
}
)";

std::filesystem::path kernel_folder() {
  const auto folder = std::filesystem::path(testing::TempDir()) / fmt::format("conformance-{}", ::getpid());
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "faulty.comp") << kKernel;
  return folder;
}

const char* fault_in_kernel() {
  switch (fault) {
    case Fault::nan_without_pdf:
      return "if (!drawn) v.power = uintBitsToFloat(0x7FC00000u);";
    case Fault::nan_position:
      return "v.position.x = uintBitsToFloat(0x7FC00000u);";
    case Fault::compile_error:
      return "v.power = sheep;";
    case Fault::power_from_nothing:
      return "if (drawn && !surface) { v = make_vpl(t, 1.0); "
             "v.normal = v.geometric_normal = v.incident = vec3(0.0, 1.0, 0.0); v.ndf = 1.0; }";
    case Fault::power_misstated:
      return "v.power *= 2.0;";
    case Fault::flux_doubled:
      return "v.power *= 2.0; v.flux *= 2.0;";
    case Fault::far_past_lights:
      return "if (i + 1u == count) lights[i + 40000u] = v;";
    case Fault::far_past_scratch:
      return "if (parameter[2] > 0.0 && i + 1u == count) lights[i + 40000u] = v;";
    case Fault::gain_at_end:
      return "v.flux.x /= parameter[1] < 1.0 ? 1.0 : 0.0;";
    default:
      return "";
  }
}

class Faulty : public Method {
 public:
  Faulty(MethodContext& context, float gain)
      : context_(context),
        kernel_(context.kernel("faulty.comp", {{"FAULT", fault_in_kernel()}})),
        gain_(gain) {
    const uint32_t zero = 0;
    if (fault == Fault::trusts_scratch) context_.scratch("mark", 16).upload(&zero, 4);
    if (fault == Fault::leaks) new Buffer(context_.device(), "leak", 1 << 20);
  }
  LightKind kind() const override { return LightKind::vpl; }

  void generate(Steps& steps, const Field& field, const LightTarget& target) override {
    const gpu::Emitter& e = field.emitter;
    if (e.width == 1 && e.height == 64) end_badly();
    if (fault == Fault::hangs_on_a_row && e.width == 64 && e.height == 1) {
      for (;;) ::pause();
    }
    if (fault == Fault::grows) kept_.emplace_back(context_.device(), "kept", 4096);
    Recorder& r = steps.recorder();
    if (fault == Fault::unnamed_pass)
      return r.pass({.step = "sample"}, [&] { dispatch(r, field, target, 0); });
    if (fault == Fault::outside_pass) return dispatch(r, field, target, 0);
    if (fault == Fault::passes_change && frames_ == 0) steps.pass("prepare", [] {});
    steps.pass("sample", [&] {
      if (fault == Fault::past_scratch || fault == Fault::far_past_scratch) {
        const Buffer& copy = context_.scratch("copy", target.count * sizeof(gpu::Vpl));
        dispatch(r, field, {&copy, target.count, target.shift}, fault == Fault::past_scratch ? 1 : 0, 1);
      }
      dispatch(r, field, target, fault == Fault::past_lights ? 1 : 0);
      if (fault == Fault::no_barrier) {
        const Buffer& copy = context_.scratch("copy", target.count * sizeof(gpu::Vpl));
        Field lights_as_pdf = field;
        lights_as_pdf.pdf = target.buffer;
        dispatch(r, lights_as_pdf, {&copy, target.count, target.shift}, 0);
      }
    });
    ++frames_;
  }

 private:
  void end_badly() const {
    ::signal(SIGSEGV, SIG_DFL);
    if (fault == Fault::crashes_on_a_column) ::raise(SIGSEGV);
    if (fault == Fault::loses_device) throw Error(ErrorKind::device_lost, "the device was lost");
    if (fault == Fault::leaves) ::_exit(0);
  }

  float scale() {
    uint32_t mark = 0;
    if (fault == Fault::trusts_scratch) context_.scratch("mark", 16).download(&mark, 4);
    const bool count = fault == Fault::counts_frames;
    return 1 + (mark == 0 ? 0.0f : 1e-3f) + (count ? 1e-4f * static_cast<float>(frames_) : 0.0f);
  }

  void dispatch(Recorder& r, const Field& field, const LightTarget& target, uint32_t too_many,
                float is_copy = 0) {
    const struct {
      gpu::Emitter emitter;
      uint32_t count, step;
      glm::uvec2 shift;
      float scale, gain, is_copy, unused;
    } push{field.emitter,
           target.count + too_many,
           lattice_step(target.count),
           fault == Fault::seed_ignored ? glm::uvec2(0) : target.shift,
           scale(),
           gain_,
           is_copy,
           0};
    r.dispatch(kernel_, {field.maps, *field.pdf, *target.buffer}, push, groups_for(push.count, 64));
  }

  MethodContext& context_;
  const Kernel& kernel_;
  float gain_;
  uint32_t frames_ = 0;
  std::vector<Buffer> kept_;
};

MethodInfo faulty_method() {
  MethodInfo info;
  info.name = "faulty";
  info.parameters = {{"gain", 0.0, "does nothing below 1", 0, 1, {}}};
  info.create = [](MethodContext& context, const Json& parameters) -> std::unique_ptr<Method> {
    const char* name = fault == Fault::undeclared ? "gian" : "gain";
    return std::make_unique<Faulty>(context, parameters.at(name).get<float>());
  };
  info.folder = kernel_folder();
  return info;
}

// Names of the checks that failed, and their failures.
struct Verdict {
  std::vector<std::string> failed;
  std::string lines;
};

Verdict verdict_on(Fault wrong, ConformanceOptions options = {}) {
  fault = wrong;
  options.large = false;
  Verdict verdict;
  check_conformance(faulty_method(), options, [&](const CheckResult& result) {
    EXPECT_EQ(result.inputs == 0, wrong == Fault::compile_error || wrong == Fault::undeclared) << result.name;
    if (!result.ok()) verdict.failed.push_back(result.name);
    for (const auto& line : result.failures) {
      verdict.lines += line + "\n";
      EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
  });
  return verdict;
}

using testing::ElementsAre;
using testing::HasSubstr;

void expect(Fault wrong, const std::vector<std::string>& checks, const std::string& line) {
  const Verdict verdict = verdict_on(wrong);
  EXPECT_EQ(verdict.failed, checks) << verdict.lines;
  EXPECT_THAT(verdict.lines, HasSubstr(line));
}

}  // namespace

TEST(Conformance, AMethodWithoutFaultPasses) {
  const Verdict verdict = verdict_on(Fault::none);
  EXPECT_THAT(verdict.failed, ElementsAre()) << verdict.lines;
}

TEST(Conformance, NanLightsAreFoundInAHalfAndInAFrame) {
  expect(Fault::nan_without_pdf, {"lights", "image"},
         "half rsm 7×5, N = 35, PDF zero everywhere: light 0 has power nan; expected a finite number ≥ 0\n");
  expect(Fault::nan_position, {"lights", "image"},
         "scene cornell, 64×36, RSM 40×40, N = 64: 160 lights with a NaN and 0 with an Inf, the first is "
         "light 0 of generate.gbuffer; expected finite numbers\n");
}

// Before any input; said in full once.
TEST(Conformance, AKernelThatDoesNotCompileIsSaidOnce) {
  const Verdict verdict = verdict_on(Fault::compile_error, {.only = {"repeatable", "flux"}});
  EXPECT_THAT(verdict.failed, ElementsAre("repeatable", "flux"));
  EXPECT_THAT(verdict.lines, HasSubstr("'sheep' : undeclared identifier (before its first input)\n"));
  EXPECT_THAT(verdict.lines, HasSubstr("\nthe same error as in repeatable\n"));
}

TEST(Conformance, AParameterThatIsNotDeclaredIsNamed) {
  const Verdict verdict = verdict_on(Fault::undeclared, {.only = {"lights"}});
  EXPECT_EQ(
      verdict.lines,
      "`create` reads parameter 'gian', which MethodInfo::parameters lacks; did you mean 'gain'? (before "
      "its first input)\n");
}

TEST(Conformance, PowerFromNothingIsFound) {
  expect(Fault::power_from_nothing, {"lights", "image"},
         "half rsm 7×5, N = 35, PDF uniform, no surface anywhere: light 0 has a power of ");
}

TEST(Conformance, PowerThatTheFluxDoesNotBearOutIsFound) {
  expect(Fault::power_misstated, {"lights", "flux"}, "but carries ");
}

TEST(Conformance, DoubledFluxIsFound) {
  expect(Fault::flux_doubled, {"flux"}, "W; expected 0.95 … 1.05 × (flux_bound = 0.05)\n");
}

TEST(Conformance, AnIgnoredSeedIsFound) {
  // Sixteen times the same lights are no mean over shifts: their power is off, too.
  expect(Fault::seed_ignored, {"repeatable", "flux"},
         "half rsm 61×35, N = 100: seeds 3 and 4 give the same lights; expected others\n");
}

TEST(Conformance, LightsThatDependOnEarlierFramesAreFound) {
  expect(Fault::counts_frames, {"repeatable", "image"},
         "a later frame of the same seed: light 0 differs; expected the same bits\n");
}

TEST(Conformance, TrustInScratchMemoryIsFound) {
  expect(Fault::trusts_scratch, {"repeatable"},
         "scratch memory that another case left full: light 0 differs; expected the same bits\n");
}

TEST(Conformance, LeakAndGrowthAreFound) {
  expect(Fault::leaks, {"memory"}, "1048576 bytes of device memory are still held");
  expect(Fault::grows, {"memory"}, "24576 bytes more device memory after four frames than after one");
}

TEST(Conformance, AMissingBarrierIsFound) {
  expect(Fault::no_barrier, {"validation"},
         "messages of the validation layers, the first: SYNC-HAZARD-READ-AFTER-WRITE: vkCmdDispatch: Hazard");
}

TEST(Conformance, AWritePastTheLightsOrScratchIsFound) {
  expect(Fault::past_lights, {"bounds"},
         "half rsm 7×5, N = 35: byte 0 past the end of the lights (3920 bytes) was written");
  expect(Fault::past_scratch, {"bounds"},
         "half rsm 7×5, N = 35: byte 0 past the end of scratch buffer 'copy' (3920 bytes) was written");
}

TEST(Conformance, AWriteFarPastTheLightsOrScratchIsFound) {
  expect(Fault::far_past_lights, {"bounds"},
         "half rsm 33×17, N = 561: byte 4479888 past the end of the lights (62832 bytes) was written");
  expect(Fault::far_past_scratch, {"bounds"},
         "half rsm 33×17, N = 561: byte 4479888 past the end of scratch buffer 'copy' (62832 bytes) was "
         "written");
}

TEST(Conformance, AnUnnamedPassAndADispatchOutsideAnyAreFound) {
  expect(Fault::unnamed_pass, {"passes"}, "a pass is named 'sample'; expected generate.rsm.<step>\n");
  expect(Fault::outside_pass, {"passes"}, "1 dispatches are outside any pass");
}

TEST(Conformance, PassesThatChangeAreFound) {
  expect(Fault::passes_change, {"passes"},
         "the first frame has the passes generate.rsm.prepare, generate.rsm.sample, the second "
         "generate.rsm.sample; expected the same\n");
}

TEST(Conformance, ParametersAreTriedAtTheirEnds) {
  expect(Fault::gain_at_end, {"lights", "flux"}, "half rsm 7×5, N = 35, gain = 1.0: light 0 ");
}

// What ends a check's process costs that check only, and the line says on what.
TEST(Conformance, ACrashCostsItsCheckOnly) {
  expect(Fault::crashes_on_a_column, {"lights", "bounds"},
         "crashed (signal 11, Segmentation fault) (on half gbuffer 1×64, N = 64)\n");
}

TEST(Conformance, AHangCostsItsCheckOnly) {
  const Verdict verdict = verdict_on(Fault::hangs_on_a_row, {.silence_s = 5, .only = {"lights", "flux"}});
  EXPECT_THAT(verdict.failed, ElementsAre("lights"));
  EXPECT_EQ(verdict.lines, "was stopped after 5 s without a sign of life (on half gbuffer 64×1, N = 3)\n");
}

TEST(Conformance, ALostDeviceOrAnEarlyEndCostsItsCheckOnly) {
  expect(Fault::loses_device, {"lights", "bounds"}, "the device was lost (on half gbuffer 1×64, N = 64)\n");
  expect(Fault::leaves, {"lights", "bounds"},
         "ended the process (exit code 0) (on half gbuffer 1×64, N = 64)\n");
}

TEST(Conformance, RefusesWhatItCantRun) {
  MethodInfo refused = faulty_method();
  refused.refused = "plugin x.so: was built for another ABI";
  const auto ignore = [](const CheckResult&) {};
  EXPECT_THROW(check_conformance(refused, {}, ignore), Error);
  EXPECT_THROW(check_conformance(faulty_method(), {.only = {"light"}}, ignore), Error);
  EXPECT_THROW(check_conformance(faulty_method(), {.device = "no such device"}, ignore), Error);
}
