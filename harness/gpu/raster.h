// A graphics pipeline for deferred targets: dynamic rendering, several colour targets, depth.
#pragma once

#include <vulkan/vulkan.h>

#include <filesystem>
#include <string>
#include <vector>

#include "gpu/kernel.h"

namespace vsglbench {

struct VertexAttribute {
  VkFormat format;
  uint32_t offset;
};

class RasterPipeline {
 public:
  RasterPipeline() = default;
  // No culling, depth test less, no blending. Attribute i is at location i of vertex binding 0. The fragment
  // shader's bindings are set 0; push constants are visible to both stages.
  RasterPipeline(Device& device, const std::filesystem::path& vertex, const std::filesystem::path& fragment,
                 const ShaderDefines& defines, const std::vector<std::filesystem::path>& include_dirs,
                 const std::vector<VkFormat>& targets, uint32_t vertex_stride,
                 const std::vector<VertexAttribute>& attributes);
  ~RasterPipeline();
  RasterPipeline(RasterPipeline&& other) noexcept { swap(other); }
  RasterPipeline& operator=(RasterPipeline&& other) noexcept {
    swap(other);
    return *this;
  }

  // Clears targets to zero and depth to one, then calls `draw` inside the rendering scope. Leaves the colour
  // targets in SHADER_READ_ONLY_OPTIMAL.
  void render(VkCommandBuffer commands, const std::vector<const DeviceImage*>& targets,
              const DeviceImage& depth, const std::function<void()>& draw) const;
  const BindingLayout& layout() const { return layout_; }

 private:
  void swap(RasterPipeline& other) noexcept;
  Device* device_ = nullptr;
  BindingLayout layout_;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}  // namespace vsglbench
