// Virtual point lights: N texels drawn by warping the PDF (Keller 1997; [VSGL14] Eq. 1).
#include "method/light_kernel.h"
#include "method/plugin.h"

VSGLBENCH_METHOD(MethodInfo{
    .summary = "virtual point lights, exact BRDFs, no filtering",
    .source = "Keller 1997; [VSGL14] Eq. 1",
    .makes_vpls = Json::object(),
    .parameters = {{"clamp", 0.0, "bound on the geometry term cos cos/d², 1/m²; 0: none", 0, 1e30, {}}},
    .flux_bound = 0.01,
    .makes_importance = LightKind::vpl,
    .light_rule = LightRule::texel,
    .create = [](MethodContext& context, const Json& parameters) {
      return make_light_kernel(context, "vpl.comp", LightKind::vpl, {parameters.at("clamp").get<float>()});
    }})
