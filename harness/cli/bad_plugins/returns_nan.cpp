#include "method/light_kernel.h"
#include "method/plugin.h"

VSGLBENCH_METHOD(MethodInfo{
    .summary = "makes lights of NaN", .source = "-", .create = [](MethodContext& context, const Json&) {
      return make_light_kernel(context, "returns_nan.comp", LightKind::vsgl);
    }})
