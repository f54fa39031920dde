// The whole RSM as two lights: the diffuse lobes of all texels in one, the specular ones in the other
// (Tokuyoshi 2015; [SGL22] §4).
#include "method/plugin.h"

namespace vsglbench {
namespace {

// Sets that one invocation merges (two_vsgl.glsl).
constexpr uint32_t kFan = 64;

class TwoLights : public Method {
 public:
  explicit TwoLights(MethodContext& context)
      : context_(context),
        texels_(context.kernel("texels.comp")),
        pairs_(context.kernel("pairs.comp")),
        lights_(context.kernel("lights.comp")) {}

  LightKind kind() const override { return LightKind::vsgl; }
  bool uses_importance() const override { return false; }
  uint32_t light_count(uint32_t, uint64_t) const override { return 2; }

  void generate(Steps& steps, const Field& field, const LightTarget& target) override {
    Recorder& r = steps.recorder();
    uint32_t count = groups_for(field.texels(), kFan);
    const Buffer* from = &pairs("pairs", field, count);
    steps.pass("sum", [&] {
      // 1. Texels, kFan at a time.  2. The sums likewise, until one is left.  3. Lights.
      r.dispatch(texels_, {field.maps, *from}, field.emitter, groups_for(count, 64));
      bool second = true;
      for (; count > 1; second = !second) {
        const uint32_t fewer = groups_for(count, kFan);
        const Buffer& to = pairs(second ? "pairs2" : "pairs", field, fewer);
        r.barrier();
        r.dispatch(pairs_, {*from, to}, count, groups_for(fewer, 64));
        from = &to;
        count = fewer;
      }
      r.barrier();
      r.dispatch(lights_, {*from, *target.buffer}, target.count, 1);
    });
  }

 private:
  const Buffer& pairs(const char* name, const Field& field, uint32_t count) {
    return context_.scratch(fmt::format("two-vsgl.{}.{}", name, half_name(field.half)),
                            2 * count * moments_bytes(context_.lobes()));
  }
  MethodContext& context_;
  const Kernel &texels_, &pairs_, &lights_;
};

}  // namespace
}  // namespace vsglbench

VSGLBENCH_METHOD(MethodInfo{.summary = "the whole RSM as one diffuse and one specular light",
                            .source = "Tokuyoshi 2015; [SGL22] Fig. 4",
                            .takes_light_count = false,
                            .light_count = 2,
                            .flux_bound = 1e-3,
                            .create = [](MethodContext& context, const Json&) -> std::unique_ptr<Method> {
                              return std::make_unique<TwoLights>(context);
                            }})
