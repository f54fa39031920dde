// A loop whose condition can never turn false.
#include "method/light_kernel.h"
#include "method/plugin.h"

VSGLBENCH_METHOD(MethodInfo{
    .summary = "loops for ever", .source = "-", .create = [](MethodContext& context, const Json&) {
      return make_light_kernel(context, "endless_loop.comp", LightKind::vsgl);
    }})
