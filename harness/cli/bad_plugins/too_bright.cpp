// Lights of a hundred times the flux that their texels reflect.
#include "method/light_kernel.h"
#include "method/plugin.h"

VSGLBENCH_METHOD(MethodInfo{
    .summary = "forgets to divide by N", .source = "-", .create = [](MethodContext& context, const Json&) {
      return make_light_kernel(context, "too_bright.comp", LightKind::vsgl);
    }})
