// k-means clusters of texels by distance in the image, searched and summed as fast as we know how [MFIS16
// App. D].
#include "method/kmeans.h"
#include "method/plugin.h"

VSGLBENCH_METHOD(kmeans_info<2, NearestCentre::Search::tiles, ClusterSumVariant::segmented>(
    "k-means in the image, searched and summed as fast as we know how"))
