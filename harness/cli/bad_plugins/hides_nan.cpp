// A NaN in a pass on the way, of which nothing is left in lights or image: only --check-passes can tell.
#include "method/light_kernel.h"
#include "method/plugin.h"

namespace vsglbench {
namespace {

class HidesNan : public Method {
 public:
  explicit HidesNan(MethodContext& context)
      : context_(context),
        weigh_(context.kernel("hides_nan.comp")),
        lights_(make_light_kernel(context, "hides_nan_lights.comp", LightKind::vsgl)) {}
  LightKind kind() const override { return LightKind::vsgl; }

  void generate(Steps& steps, const Field& field, const LightTarget& target) override {
    const auto texels = static_cast<uint32_t>(field.texels());
    const Buffer& weights = context_.scratch("weights", texels * sizeof(float));
    steps.pass("weigh", [&] {
      const bool rsm = field.half == Half::rsm;
      const struct { uint32_t count, at; } push{texels, rsm ? 3 * field.emitter.width + 5 : texels};
      steps.recorder().dispatch(weigh_, {weights}, push, groups_for(texels, 64));
    });
    steps.pass("forget", [&] { steps.recorder().fill(weights, 0); });
    lights_->generate(steps, field, target);
  }

 private:
  MethodContext& context_;
  const Kernel& weigh_;
  std::unique_ptr<Method> lights_;
};

}  // namespace
}  // namespace vsglbench

VSGLBENCH_METHOD(MethodInfo{.summary = "loses a NaN on the way",
                            .source = "-",
                            .create = [](MethodContext& context, const Json&) -> std::unique_ptr<Method> {
                              return std::make_unique<HidesNan>(context);
                            }})
