// Lights of a hundred times the flux that their texels reflect.
#include "bad_method.h"
#include "method/light_kernel.h"

VSGLBENCH_METHOD(bad_method("forgets to divide by N", [](MethodContext& context, const Json&) {
  return make_light_kernel(context, "too_bright.comp", LightKind::vsgl);
}))
