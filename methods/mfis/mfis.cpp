// Modified filtered importance sampling: mip level from the PDF's integral over the footprint [MFIS16 Eq. 3,
// 5].
#include "method/filtered_sampling.h"
#include "method/plugin.h"

VSGLBENCH_METHOD(MethodInfo{
    .summary = "modified filtered importance sampling, footprints of equal probability",
    .source = "[MFIS16] Eq. 3, 5, Alg. 1",
    .parameters = {{"K", 1.0, "footprint size: each footprint holds K/N of the probability", 1e-6, 1e6, {}}},
    .flux_bound = 0.03,
    .uneven_flux_bound = 0.3,  // [MFIS16 Eq. 5] itself: E[Σ] = ∫ f̄ p/p̄
    .makes_importance = LightKind::vsgl,
    .light_rule = LightRule::equal_probability,
    .published_code_size = PublishedCodeSize{2, 2, 232},
    .create = [](MethodContext& context, const Json& parameters) {
      return make_filtered_sampling(context, "mfis.comp", parameters.at("K").get<float>());
    }})
