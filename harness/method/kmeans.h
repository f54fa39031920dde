// Clusters of texels around centres drawn by the PDF, one VSGL each: k-means without or with Lloyd's steps
// [MFIS16 App. D].
#pragma once

#include <memory>
#include <optional>

#include "method/cluster_sum.h"
#include "method/method.h"
#include "method/nearest_centre.h"
#include "method/radix_sort.h"

namespace vsglbench {

struct KMeansParameters {
  int dimensions = 2;  // 2: distance in the image, in texels; 3: in the world, in metres
  NearestCentre::Search search = NearestCentre::Search::kd_tree;
  ClusterSumVariant sum = ClusterSumVariant::per_cluster;
  uint32_t iterations =
      0;  // Lloyd's steps: each moves every centre to its texels' mean, weighted with the PDF
};

// Steps `assign` (centres, tree, nearest centre of every texel), `sort` (texels by cluster) and `sum` as
// [MFIS16 Tab. 1] reports them; `assign` and `sort` come once more for every Lloyd step, with `move` between.
std::unique_ptr<Method> make_kmeans(MethodContext& context, const KMeansParameters& parameters);

// The parameter `iterations`.
ParameterInfo lloyd_iterations();

// A k-means method: what all of them say of themselves.
template <int dimensions, NearestCentre::Search search, ClusterSumVariant sum>
MethodInfo kmeans_info(const std::string& summary,
                       const std::optional<PublishedCodeSize>& published_code_size = std::nullopt) {
  return {
      .summary = summary,
      .source = "[MFIS16] App. D",
      .parameters = {lloyd_iterations()},
      .flux_bound = 1e-4,  // every texel is in one cluster
      .published_code_size = published_code_size,
      .create = [](MethodContext& context, const Json& parameters) {
        return make_kmeans(context, {dimensions, search, sum, parameters.at("iterations").get<uint32_t>()});
      }};
}

}  // namespace vsglbench
