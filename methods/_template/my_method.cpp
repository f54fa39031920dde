// my-method: one VSGL from each texel that the PDF draws, blurred to the size of its share.
#include "method/light_kernel.h"
#include "method/plugin.h"

VSGLBENCH_METHOD(MethodInfo{
    .summary = "my-method: one blurred texel a light",
    .source = "-",
    .parameters = {{"blur", 1.0, "variance of a light, as a part of the area it stands for", 0.0, 100.0, {}}},
    .flux_bound = 0.1,  // unbiased: only the noise of the drawn texels is left
    .create = [](MethodContext& context, const Json& parameters) {
      return make_light_kernel(context, "my_method.comp", LightKind::vsgl,
                               {parameters.at("blur").get<float>()});
    }})
