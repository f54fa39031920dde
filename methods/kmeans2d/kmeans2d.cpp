// k-means clusters of texels by distance in the image, one thread a cluster sums it [MFIS16 App. D].
#include "method/kmeans.h"
#include "method/plugin.h"

VSGLBENCH_METHOD(MethodInfo{.summary = "k-means in the image, one thread a cluster sums it",
                            .source = "[MFIS16] App. D",
                            .parameters = {lloyd_iterations()},
                            .flux_bound = 1e-4,  // every texel is in one cluster
                            .create = [](MethodContext& context, const Json& parameters) {
                              return make_kmeans(context,
                                                 {.dimensions = 2,
                                                  .search = NearestCentre::Search::kd_tree,
                                                  .sum = ClusterSumVariant::per_cluster,
                                                  .iterations = parameters.at("iterations").get<uint32_t>()});
                            }})
