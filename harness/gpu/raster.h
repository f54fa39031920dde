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

  // What targets and depth hold before anything is drawn: zero and one, or what was copied into them, which
  // are in TRANSFER_DST_OPTIMAL then.
  enum class Start { cleared, copied };
  // Calls `draw` inside the rendering scope. Leaves the colour targets in SHADER_READ_ONLY_OPTIMAL, and the
  // depth in DEPTH_ATTACHMENT_OPTIMAL.
  void render(VkCommandBuffer commands, const std::vector<const DeviceImage*>& targets,
              const DeviceImage& depth, Start start, const std::function<void()>& draw) const;
  // Within `draw`: binds, and pushes to both stages; throws as BindingLayout does.
  template <class Push>
  void bind(VkCommandBuffer commands, DescriptorArena& arena, const Bindings& bindings,
            const Push& push) const {
    static_assert(std::is_trivially_copyable_v<Push>);
    layout_.bind(commands, arena, VK_PIPELINE_BIND_POINT_GRAPHICS, bindings);
    layout_.push_constants(commands, &push, sizeof push);
  }

 private:
  void swap(RasterPipeline& other) noexcept;
  Device* device_ = nullptr;
  BindingLayout layout_;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}  // namespace vsglbench
