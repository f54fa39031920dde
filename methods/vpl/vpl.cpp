// Virtual point lights: N texels drawn by warping the PDF (Keller 1997; [VSGL14] Eq. 1).
#include "method/light_kernel.h"
#include "method/plugin.h"

VSGLBENCH_METHOD(MethodInfo{.summary = "virtual point lights, exact BRDFs, no filtering, no clamping",
                            .source = "Keller 1997; [VSGL14] Eq. 1",
                            .makes_vpls = Json::object(),
                            .flux_bound = 0.01,
                            .create = [](MethodContext& context, const Json&) {
                              return make_light_kernel(context, "vpl.comp", LightKind::vpl);
                            }})
