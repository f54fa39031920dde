// Pushes 8 bytes to a kernel whose block has more (block: larger) or fewer (smaller).
#include "bad_method.h"

namespace {

using namespace vsglbench;

void dispatch(Recorder& recorder, const Kernel& kernel, const Field&, const LightTarget& target) {
  const struct {
    uint32_t count;
    float scale;
  } push{target.count, 1};
  recorder.dispatch(kernel, {*target.buffer}, push, groups_for(target.count, 64));
}

}  // namespace

VSGLBENCH_METHOD(MethodInfo{
    .summary = "pushes another block than its kernel has",
    .source = "-",
    .parameters = {{"block", "larger", "the kernel's, against the host's", 0, 0, {"larger", "smaller"}}},
    .create = [](MethodContext& context, const Json& parameters) -> std::unique_ptr<Method> {
      const char* larger = parameters.at("block") == "larger" ? "1" : "0";
      return std::make_unique<BadKernel>(context.kernel("push_block.comp", {{"LARGER", larger}}), dispatch);
    }})
