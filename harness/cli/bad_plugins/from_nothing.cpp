// Lights of one watt each, whatever the texels reflect.
#include "method/plugin.h"

namespace vsglbench {
namespace {

class Bad : public Method {
 public:
  Bad(MethodContext& context, const Json&) : kernel_(context.kernel("from_nothing.comp")) {}
  LightKind kind() const override { return LightKind::vsgl; }
  bool uses_importance() const override { return false; }
  void generate(Steps& steps, const Field& field, const LightTarget& target) override {
    const struct {
      gpu::Emitter emitter;
      uint32_t count;
    } push{field.emitter, target.count};
    const auto& m = field.maps;
    steps.pass("write", [&] {
      steps.recorder().dispatch(kernel_, {*m[0], *m[1], *m[2], *m[3], *m[4], *target.buffer}, push,
                                groups_for(target.count, 64));
    });
  }

 private:
  const Kernel& kernel_;
};

}  // namespace
}  // namespace vsglbench

VSGLBENCH_METHOD(MethodInfo{
    .summary = "makes power from nothing",
    .source = "-",
    .create = [](MethodContext& context, const Json& parameters) -> std::unique_ptr<Method> {
      return std::make_unique<Bad>(context, parameters);
    }})
