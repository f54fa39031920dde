// k-means clusters of texels by distance in the image, one thread a cluster sums it [MFIS16 App. D].
#include "method/kmeans.h"
#include "method/plugin.h"

VSGLBENCH_METHOD(kmeans_info<2, NearestCentre::Search::kd_tree, ClusterSumVariant::per_cluster>(
    "k-means in the image, one thread a cluster sums it", PublishedCodeSize{9, 39, 1143}))
