// What stands still in an animation, drawn once: a frame in motion copies it, and draws what moves over it.
#pragma once

#include <map>
#include <memory>
#include <tuple>

#include "frame/scene_gpu.h"

namespace vsglbench {

class StillLayers {
 public:
  StillLayers(Device& device, SceneGpu& geometry) : device_(device), geometry_(geometry) {}
  // Targets like `targets`, in TRANSFER_SRC_OPTIMAL, that hold SceneGpu::Part::still as it is seen from
  // `view`, which is the same of a half and size until clear(). Where they are not there yet they are drawn,
  // and the device is waited for. `defines`: as of SceneGpu::draw().
  const DeferredTargets& get(Half half, const View& view, const Buffer& viewer,
                             const DeferredTargets& targets, const ShaderDefines& defines);
  void clear() { layers_.clear(); }

 private:
  using Key = std::tuple<Half, uint32_t, uint32_t, ShaderDefines>;
  Device& device_;
  SceneGpu& geometry_;
  std::map<Key, std::unique_ptr<DeferredTargets>> layers_;
};

// Copies all maps and the depth. Inside a pass; leaves `to` in TRANSFER_DST_OPTIMAL.
void copy_layer(VkCommandBuffer commands, const DeferredTargets& from, const DeferredTargets& to);

}  // namespace vsglbench
