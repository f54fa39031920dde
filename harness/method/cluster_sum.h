// One VSGL from the texels of each cluster [MFIS16 App. B, D].
#pragma once

#include "method/method.h"

namespace vsglbench {

enum class ClusterSumVariant {
  // One thread sums one cluster, as the paper does: its time is that of the largest cluster [MFIS16 §5]. On
  // lavapipe in several dispatches, as that ends long loops.
  per_cluster,
  // Clusters are cut into pieces of at most 64 texels, one thread sums a piece, and pieces are summed the
  // same way, up to one a cluster. Its time is at most that of count + 64 N texels, however they are spread.
  segmented
};

// Both variants make the same lights but for rounding, and the same bits each time: no atomics, no subgroup
// operations, an order of summation that depends on the cluster alone.
class ClusterSum {
 public:
  ClusterSum(MethodContext& context, ClusterSumVariant variant);

  // Texels sorted by cluster.
  struct SortedTexels {
    const Buffer* ids = nullptr;     // uint32, ascending; N and above: no cluster
    const Buffer* texels = nullptr;  // uint32, y * width + x
    uint32_t count = 0;
  };

  // Writes target.count = N records of Vsgl, inside the recorder's current pass, which must make ids and
  // texels visible; the lights are visible to what is recorded after. A light's level is -1, and a cluster
  // without texels or without power gives no_light() (shaders/moments.glsl). Powers are plain sums (factor
  // 1). Uses scratch buffers "cluster.*" of the context, named by half: of two sums for one half in one
  // submission, the second must not be the larger. Throws std::logic_error where `sorted` or the target's
  // buffer is missing or too small.
  void record(Recorder& recorder, const Field& field, const SortedTexels& sorted, const LightTarget& target);

 private:
  const Buffer& scratch(Half half, const char* name, size_t bytes);
  void record_linear(Recorder& r, const Field& field, const SortedTexels& sorted, const LightTarget& target);
  void record_segmented(Recorder& r, const Field& field, const SortedTexels& sorted,
                        const LightTarget& target);

  // Records the search for where each cluster starts, into a buffer with room for `levels` of starts.
  const Buffer& record_starts(Recorder& r, const Field& field, const SortedTexels& sorted, uint32_t clusters,
                              uint32_t levels);

  MethodContext& context_;
  ClusterSumVariant variant_;
  const Kernel* starts_;
  const Kernel *linear_ = nullptr, *pieces_ = nullptr, *leaves_ = nullptr, *partials_ = nullptr,
               *lights_ = nullptr;
};

}  // namespace vsglbench
