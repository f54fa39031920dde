// Sound lights on the RSM; those on the G-buffer are finite, and what they shine on is no number.
#include "bad_method.h"
#include "method/light_kernel.h"

VSGLBENCH_METHOD(bad_method("makes importance of NaN", [](MethodContext& context, const Json&) {
  return make_light_kernel(context, "nan_importance.comp", LightKind::vsgl);
}))
