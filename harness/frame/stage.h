// What one scene's cases share: geometry, targets, kernels and memory.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <tuple>

#include "frame/permutation.h"
#include "frame/scene_gpu.h"
#include "frame/still_layers.h"
#include "frame/visibility.h"
#include "method/context.h"
#include "method/method.h"

namespace vsglbench {

// The memory of frames, apart from the methods' own. Every frame overwrites it.
struct FrameMemory {
  std::array<GrowingBuffer, 2> pdf;  // by half
  // By half and size: a method may clear its whole buffer, and what lies behind its lights is watched.
  std::array<std::map<size_t, GrowingBuffer>, 2> lights;
  GrowingBuffer light_texels, filtered_lights, shares, indirect, direct;
  std::map<size_t, GrowingBuffer> visibility;  // bits, by range of lights
  ShadowMapMemory shadow_maps;
};

class Stage {
 public:
  // Keeps a reference to `scene`, which must not change while the stage lives but by set_frame(), after which
  // follow() is due, and then that of every frame that is to render.
  Stage(Device& device, KernelLibrary& kernels, const Scene& scene);
  // Takes over what set_frame() moved. What stands still is not uploaded again. Points and clusters of shadow
  // maps lie on all surfaces, and are made anew where objects moved. Returns the bytes uploaded.
  size_t follow(const Moved& moved);
  Device& device;
  KernelLibrary& kernels;
  const Scene& scene;
  ScratchPool scratch;  // of methods
  FrameMemory memory;
  SceneGpu geometry;
  StillLayers still_layers;  // of frames in motion
  // With the channels that the effects ask for.
  DeferredTargets& targets(Half half, uint32_t width, uint32_t height,
                           const EffectSet& effects = EffectSet::all());
  ImperfectShadowMaps& shadow_maps(Visibility technique, const IsmParameters& parameters);

 private:
  std::map<std::tuple<Half, uint32_t, uint32_t, Channels>, std::unique_ptr<DeferredTargets>> targets_;
  std::map<std::tuple<Visibility, uint32_t, uint32_t>, std::unique_ptr<ImperfectShadowMaps>> shadow_maps_;
};

// A kernel of this room.
std::filesystem::path frame_kernel(const char* file);

}  // namespace vsglbench
