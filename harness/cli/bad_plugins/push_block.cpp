// Pushes 8 bytes to a kernel whose block has more (block: larger) or fewer (smaller).
#include "method/plugin.h"

namespace vsglbench {
namespace {

class Bad : public Method {
 public:
  Bad(MethodContext& context, const Json& parameters)
      : kernel_(context.kernel("push_block.comp",
                               {{"LARGER", parameters.at("block") == "larger" ? "1" : "0"}})) {}
  LightKind kind() const override { return LightKind::vsgl; }
  bool uses_importance() const override { return false; }
  void generate(Steps& steps, const Field&, const LightTarget& target) override {
    const struct {
      uint32_t count;
      float scale;
    } push{target.count, 1};
    steps.pass("write", [&] {
      steps.recorder().dispatch(kernel_, {*target.buffer}, push, groups_for(target.count, 64));
    });
  }

 private:
  const Kernel& kernel_;
};

}  // namespace
}  // namespace vsglbench

VSGLBENCH_METHOD(MethodInfo{
    .summary = "pushes another block than its kernel has",
    .source = "-",
    .parameters = {{"block", "larger", "the kernel's, against the host's", 0, 0, {"larger", "smaller"}}},
    .create = [](MethodContext& context, const Json& parameters) -> std::unique_ptr<Method> {
      return std::make_unique<Bad>(context, parameters);
    }})
