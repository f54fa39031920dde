// The scene's surface in clusters of near triangles, for shadow maps that choose their points by cluster.
#pragma once

#include <array>
#include <vector>

#include "gpu/buffer.h"
#include "scene/scene.h"

namespace vsglbench {

struct SurfaceCluster {
  glm::vec3 centre{0};
  float radius = 0;  // of a sphere about `centre` that holds its triangles, metres
  uint32_t first = 0, count = 0;
  float area = 0;          // m²
  float longest_edge = 0;  // m
  // Σ area n nᵀ / area: xx, yy, zz, xy, xz, yz. ω turned into it gives the mean square of cos(n, ω).
  std::array<float, 6> facing{};
};
static_assert(sizeof(SurfaceCluster) == 56);

struct SurfaceClusters {
  static constexpr uint32_t kMost = 4096;  // clusters, whatever the number of triangles
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;  // cluster after cluster, in each by falling longest edge
  std::vector<float> area;            // of the cluster's triangles up to and including this one, m²
  std::vector<SurfaceCluster> clusters;
};

// Triangles of over 1/1024 of the scene's area are halved until they are smaller; then near ones of like size
// (along the Morton curve) share a cluster. Triangles without area are left out.
SurfaceClusters cluster_surface(const Scene& scene);

struct SurfaceClustersGpu {
  SurfaceClustersGpu() = default;
  SurfaceClustersGpu(Device& device, const SurfaceClusters& surface);
  Buffer positions, triangles, area, clusters;
  uint32_t cluster_count = 0;
  size_t bytes() const { return positions.size() + triangles.size() + area.size() + clusters.size(); }
};

}  // namespace vsglbench
