// Filtered importance sampling: mip level from the PDF at the footprint's centre [MFIS16 Eq. 1, 4].
#include "method/filtered_sampling.h"
#include "method/plugin.h"

VSGLBENCH_METHOD(MethodInfo{
    .summary = "filtered importance sampling, footprint size from the PDF at the footprint's centre",
    .source = "[MFIS16] Eq. 1, 4; Tokuyoshi 2015",
    .parameters = {{"K", 1.0, "footprint size: K/N of the image at mean density", 1e-6, 1e6, {}}},
    .flux_bound = 0.01,
    .light_rule = LightRule::pdf_at_centre,
    .published_code_size = PublishedCodeSize{2, 2, 222},
    .create = [](MethodContext& context, const Json& parameters) {
      return make_filtered_sampling(context, "fis.comp", parameters.at("K").get<float>());
    }})
