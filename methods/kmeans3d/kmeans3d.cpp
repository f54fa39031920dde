// k-means clusters of texels by distance in the world, one thread a cluster sums it [MFIS16 App. D].
#include "method/kmeans.h"
#include "method/plugin.h"

VSGLBENCH_METHOD(kmeans_info<3, NearestCentre::Search::kd_tree, ClusterSumVariant::per_cluster>(
    "k-means in the world, one thread a cluster sums it", PublishedCodeSize{9, 39, 1172}))
