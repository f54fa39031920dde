// `mfis` with centres from Metropolis-Hastings chains, coherent from frame to frame (Barák et al. 2013).
#include "method/filtered_sampling.h"
#include "method/plugin.h"

VSGLBENCH_METHOD(MethodInfo{
    .summary =
        "footprints of equal probability round Metropolis-Hastings centres, coherent from frame to frame",
    .source = "Barák et al. 2013; [MFIS16] §6, Fig. 8",
    .parameters =
        {{"K", 1.0, "footprint size: each footprint holds K/N of the probability", 1e-6, 1e6, {}},
         {"steps", 64, "of each chain, in each frame", 1, 4096, {}},
         {"chains",
          "fresh",
          "over an animation: started anew in every frame, or going on where the frame before left them",
          0,
          0,
          {"fresh", "carried"}}},
    .flux_bound = 0.1,
    .uneven_flux_bound = 0.3,  // as of mfis
    .create = [](MethodContext& context, const Json& parameters) {
      const bool carried = parameters.at("chains") == "carried";
      return make_filtered_sampling(context, "mfis_mh.comp", parameters.at("K").get<float>(),
                                    {{"STEPS", parameters.at("steps").dump() + "u"}},
                                    carried ? 3 * sizeof(float) : 0);
    }})
