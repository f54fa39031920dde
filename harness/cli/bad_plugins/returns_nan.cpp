#include "bad_method.h"
#include "method/light_kernel.h"

VSGLBENCH_METHOD(bad_method("makes lights of NaN", [](MethodContext& context, const Json&) {
  return make_light_kernel(context, "returns_nan.comp", LightKind::vsgl);
}))
