#include "frame/still_layers.h"

namespace vsglbench {
namespace {

Channels channels_of(const DeferredTargets& targets) {
  return {.geometric_normal = bool(targets.maps[2]),
          .diffuse = bool(targets.maps[3]),
          .f0 = bool(targets.maps[4])};
}

void copy(VkCommandBuffer commands, const DeviceImage& from, const DeviceImage& to) {
  const VkImageAspectFlags aspect = from.is_depth() ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
  const VkImageSubresourceLayers layer{aspect, 0, 0, 1};
  const VkImageCopy region{
      .srcSubresource = layer, .dstSubresource = layer, .extent = {from.width(), from.height(), 1}};
  transition(commands, to, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  vkCmdCopyImage(commands, from.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.handle(),
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

}  // namespace

const DeferredTargets& StillLayers::get(Half half, const View& view, const Buffer& viewer,
                                        const DeferredTargets& targets, const ShaderDefines& defines) {
  auto& slot = layers_[{half, targets.width, targets.height, defines}];
  if (slot) return *slot;
  auto layer = std::make_unique<DeferredTargets>(device_, fmt::format("still {}", half_name(half)),
                                                 targets.width, targets.height, channels_of(targets),
                                                 VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
  Recorder recorder(device_);
  recorder.begin();
  recorder.pass({PassStage::draw, half, ""}, [&] {
    geometry_.draw(recorder, view, viewer, *layer, defines, SceneGpu::Part::still);
    for (const DeviceImage& map : layer->maps) {
      if (map)
        transition(recorder.commands(), map, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                   VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    }
    transition(recorder.commands(), layer->depth, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  });
  recorder.submit_and_wait();
  slot = std::move(layer);
  return *slot;
}

void copy_layer(VkCommandBuffer commands, const DeferredTargets& from, const DeferredTargets& to) {
  for (size_t i = 0; i < from.maps.size(); ++i)
    if (from.maps[i]) copy(commands, from.maps[i], to.maps[i]);
  copy(commands, from.depth, to.depth);
}

}  // namespace vsglbench
