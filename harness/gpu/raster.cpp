#include "gpu/raster.h"

#include <utility>

#include "base/error.h"
#include "gpu/check.h"

namespace vsglbench {
namespace {

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits bit, VkShaderModule module) {
  return {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
          .stage = bit,
          .module = module,
          .pName = "main"};
}

VkRenderingAttachmentInfo attachment(const DeviceImage& image, VkImageLayout layout, VkAttachmentLoadOp load,
                                     VkClearValue clear) {
  return {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
          .imageView = image.view(),
          .imageLayout = layout,
          .loadOp = load,
          .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
          .clearValue = clear};
}

}  // namespace

RasterPipeline::RasterPipeline(Device& device, const std::filesystem::path& vertex,
                               const std::filesystem::path& fragment, const ShaderDefines& defines,
                               const std::vector<std::filesystem::path>& include_dirs,
                               const std::vector<VkFormat>& targets, uint32_t vertex_stride,
                               const std::vector<VertexAttribute>& attributes)
    : device_(&device) {
  const auto vertex_code = compile_shader(vertex, defines, include_dirs);
  const auto fragment_code = compile_shader(fragment, defines, include_dirs);
  layout_ = BindingLayout(device, fragment.filename().string(), {&fragment_code, &vertex_code},
                          VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT);
  const VkShaderModule modules[] = {make_shader_module(device, vertex_code),
                                    make_shader_module(device, fragment_code)};
  const VkPipelineShaderStageCreateInfo stages[] = {stage(VK_SHADER_STAGE_VERTEX_BIT, modules[0]),
                                                    stage(VK_SHADER_STAGE_FRAGMENT_BIT, modules[1])};
  const VkVertexInputBindingDescription binding{0, vertex_stride, VK_VERTEX_INPUT_RATE_VERTEX};
  std::vector<VkVertexInputAttributeDescription> inputs;
  for (uint32_t i = 0; i < attributes.size(); ++i)
    inputs.push_back({i, 0, attributes[i].format, attributes[i].offset});
  const VkPipelineVertexInputStateCreateInfo vertex_input{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
      .vertexBindingDescriptionCount = 1,
      .pVertexBindingDescriptions = &binding,
      .vertexAttributeDescriptionCount = static_cast<uint32_t>(inputs.size()),
      .pVertexAttributeDescriptions = inputs.data()};
  const VkPipelineInputAssemblyStateCreateInfo assembly{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
      .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
  const VkPipelineViewportStateCreateInfo viewport{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1, .scissorCount = 1};
  const VkPipelineRasterizationStateCreateInfo raster{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
      .cullMode = VK_CULL_MODE_NONE,
      .lineWidth = 1};
  const VkPipelineMultisampleStateCreateInfo samples{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
      .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
  const VkPipelineDepthStencilStateCreateInfo depth{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
      .depthTestEnable = VK_TRUE,
      .depthWriteEnable = VK_TRUE,
      .depthCompareOp = VK_COMPARE_OP_LESS};
  const std::vector<VkPipelineColorBlendAttachmentState> blends(targets.size(), {.colorWriteMask = 0xf});
  const VkPipelineColorBlendStateCreateInfo blend{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
      .attachmentCount = static_cast<uint32_t>(blends.size()),
      .pAttachments = blends.data()};
  const VkDynamicState dynamic_states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  const VkPipelineDynamicStateCreateInfo dynamic{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
      .dynamicStateCount = 2,
      .pDynamicStates = dynamic_states};
  const VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                .colorAttachmentCount = static_cast<uint32_t>(targets.size()),
                                                .pColorAttachmentFormats = targets.data(),
                                                .depthAttachmentFormat = VK_FORMAT_D32_SFLOAT};
  const VkGraphicsPipelineCreateInfo create{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .pNext = &rendering,
                                            .stageCount = 2,
                                            .pStages = stages,
                                            .pVertexInputState = &vertex_input,
                                            .pInputAssemblyState = &assembly,
                                            .pViewportState = &viewport,
                                            .pRasterizationState = &raster,
                                            .pMultisampleState = &samples,
                                            .pDepthStencilState = &depth,
                                            .pColorBlendState = &blend,
                                            .pDynamicState = &dynamic,
                                            .layout = layout_.pipeline_layout()};
  VK_CHECK(vkCreateGraphicsPipelines(device.handle(), VK_NULL_HANDLE, 1, &create, nullptr, &pipeline_));
  for (const VkShaderModule module : modules) vkDestroyShaderModule(device.handle(), module, nullptr);
}

RasterPipeline::~RasterPipeline() {
  if (pipeline_) vkDestroyPipeline(device_->handle(), pipeline_, nullptr);
}

void RasterPipeline::swap(RasterPipeline& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(layout_, other.layout_);
  std::swap(pipeline_, other.pipeline_);
}

void RasterPipeline::render(VkCommandBuffer commands, const std::vector<const DeviceImage*>& targets,
                            const DeviceImage& depth, Start start, const std::function<void()>& draw) const {
  const bool cleared = start == Start::cleared;
  const VkImageLayout before = cleared ? VK_IMAGE_LAYOUT_UNDEFINED : VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  const VkAttachmentLoadOp load = cleared ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
  std::vector<VkRenderingAttachmentInfo> colors;
  for (const DeviceImage* target : targets) {
    transition(commands, *target, before, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    colors.push_back(attachment(*target, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, load, {}));
  }
  transition(commands, depth, before, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
  const auto depth_info =
      attachment(depth, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, load, {.depthStencil = {.depth = 1.0f}});
  const VkRect2D area{{0, 0}, {depth.width(), depth.height()}};
  const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                             .renderArea = area,
                             .layerCount = 1,
                             .colorAttachmentCount = static_cast<uint32_t>(colors.size()),
                             .pColorAttachments = colors.data(),
                             .pDepthAttachment = &depth_info};
  vkCmdBeginRendering(commands, &info);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
  const VkViewport viewport{0, 0, static_cast<float>(depth.width()), static_cast<float>(depth.height()),
                            0, 1};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &area);
  draw();
  vkCmdEndRendering(commands);
  for (const DeviceImage* target : targets) {
    transition(commands, *target, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  }
}

}  // namespace vsglbench
