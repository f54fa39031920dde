// A loop whose condition can never turn false.
#include "bad_method.h"
#include "method/light_kernel.h"

VSGLBENCH_METHOD(bad_method("loops for ever", [](MethodContext& context, const Json&) {
  return make_light_kernel(context, "endless_loop.comp", LightKind::vsgl);
}))
