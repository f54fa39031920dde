#include "frame/stage.h"

#include "base/file.h"

namespace vsglbench {

std::filesystem::path frame_kernel(const char* file) { return data_root() / "harness" / "frame" / file; }

Stage::Stage(Device& d, KernelLibrary& k, const Scene& s)
    : device(d), kernels(k), scene(s), scratch(d), geometry(d, s), still_layers(d, geometry) {}

size_t Stage::follow(const Moved& moved) {
  if (!moved.objects.empty()) shadow_maps_.clear();
  return geometry.update(scene, moved);
}

DeferredTargets& Stage::targets(Half half, uint32_t width, uint32_t height, const EffectSet& effects) {
  const unsigned lobes = lobes_of(effects, half);
  const Channels channels{.geometric_normal = !has_face_normals(effects),
                          .diffuse = (lobes & DIFFUSE_LOBE) != 0,
                          .f0 = (lobes & SPECULAR_LOBE) != 0};
  auto& slot = targets_[{half, width, height, channels}];
  const VkImageUsageFlags copied_into =
      scene.animation.moves.any() ? VkImageUsageFlags{VK_IMAGE_USAGE_TRANSFER_DST_BIT} : 0;
  if (!slot)
    slot = std::make_unique<DeferredTargets>(device, half_name(half), width, height, channels, copied_into);
  return *slot;
}

ImperfectShadowMaps& Stage::shadow_maps(Visibility technique, const IsmParameters& p) {
  auto& slot = shadow_maps_[{technique, p.size, p.points}];
  if (!slot) slot = std::make_unique<ImperfectShadowMaps>(kernels, memory.shadow_maps, scene, technique, p);
  return *slot;
}

}  // namespace vsglbench
