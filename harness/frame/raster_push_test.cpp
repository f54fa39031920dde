// The rasteriser's push constants are held to its shaders' block, as those of dispatches are.
#include <gtest/gtest.h>

#include <cstddef>

#include "base/error.h"
#include "frame/scene_gpu.h"
#include "frame/stage.h"

using namespace vsglbench;

namespace {

// What a mirror by hand becomes when a field is added to it, or forgotten.
struct Longer {
  gpu::DrawPush push;
  float more;
};
struct Shorter {
  glm::mat4 view_projection;
};

template <class Push>
std::string refusal(Device& device, const Push& push) {
  const RasterPipeline pipeline(device, frame_kernel("gbuffer.vert"), frame_kernel("gbuffer.frag"), {},
                                KernelLibrary::include_dirs(),
                                std::vector<VkFormat>(5, VK_FORMAT_R32G32B32A32_SFLOAT), sizeof(gpu::Vertex),
                                {{VK_FORMAT_R32G32B32_SFLOAT, offsetof(gpu::Vertex, position)},
                                 {VK_FORMAT_R32G32B32_SFLOAT, offsetof(gpu::Vertex, normal)},
                                 {VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::Vertex, tangent)},
                                 {VK_FORMAT_R32G32_SFLOAT, offsetof(gpu::Vertex, uv)}});
  const DeviceImage map(device, "map", VK_FORMAT_R8G8B8A8_UNORM, 1, 1,
                        VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  const Buffer buffer(device, "buffer", sizeof(gpu::Emitter));
  Recorder recorder(device);
  recorder.begin();
  try {
    pipeline.bind(recorder.commands(), recorder.descriptors(), {map, map, map, buffer, buffer}, push);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST(RasterPush, ABlockOfAnotherSizeIsRefused) {
  Device device;
  EXPECT_EQ(refusal(device, gpu::DrawPush{}), "");
  EXPECT_NE(refusal(device, Longer{})
                .find("gbuffer.frag: its push-constant block has 112 bytes, and the host pushes 116"),
            std::string::npos);
  EXPECT_NE(refusal(device, Shorter{}).find("has 112 bytes, and the host pushes 64"), std::string::npos);
}
