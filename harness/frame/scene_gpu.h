// A scene in device memory, and the pass that draws it into deferred targets.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "gpu/raster.h"
#include "gpu/recorder.h"
#include "method/method.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "shaders/types.h"

namespace vsglbench {

// Which targets there are beside position and normal.
struct Channels {
  bool geometric_normal = true, diffuse = true, f0 = true;
  auto operator<=>(const Channels&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14
};

// The targets of one half, in the order of FieldMaps, and their depth.
struct DeferredTargets {
  DeferredTargets(Device& device, const std::string& name, uint32_t width, uint32_t height,
                  const Channels& channels = {}, VkImageUsageFlags more_usage = 0);
  uint32_t width, height;
  std::array<DeviceImage, 5> maps;  // one that no channel asks for is empty
  DeviceImage depth;
  FieldMaps field_maps() const;
  // The map whose xyz is the face's normal.
  const DeviceImage& geometric_normals() const { return maps[2] ? maps[2] : maps[1]; }
};

// The parameters of a view as the shaders read them. `importance`: every texel emits 1/(width height)
// instead of the light's flux.
gpu::Emitter make_emitter(const View& view, uint32_t width, uint32_t height, const glm::vec3& power,
                          bool importance);

class SceneGpu {
 public:
  // Uploads geometry and textures; throws Error(case_failed) when they don't fit.
  SceneGpu(Device& device, const Scene& scene);
  // What is drawn. Of two surfaces at one depth the first that is drawn is seen: `still` is all that comes
  // before the first object that moves in any frame, and `moving` the rest, over what copy_layer() left in
  // the targets.
  enum class Part { all, still, moving };
  // Draws as seen from `view` into `targets`. Inside a pass. Returns the triangles.
  // `defines`: raster_permutation() of the effects that `targets` were made for.
  uint64_t draw(Recorder& recorder, const View& view, const Buffer& viewer, const DeferredTargets& targets,
                const ShaderDefines& defines = {}, Part part = Part::all);
  uint64_t triangle_count() const { return triangles_; }
  // Uploads what set_frame() moved of `scene`, the one this was made of: vertices and face normals of those
  // objects and nothing else. Waits for the device; no frame may be at work. Returns the bytes.
  size_t update(const Scene& scene, const Moved& moved);

 private:
  struct Draw {
    gpu::DrawPush push{};
    uint32_t first_index = 0, index_count = 0;
    std::array<int, 3> textures{-1, -1, -1};
  };
  void upload_geometry(Device& device, const Scene& scene);
  size_t upload_vertices(const Scene& scene, size_t first, size_t count);
  size_t upload_face_normals(const Scene& scene, size_t first, size_t count);
  void upload_textures(Device& device, const Scene& scene);
  void make_draws(const Scene& scene);

  Buffer vertices_, indices_, face_normals_;
  std::vector<DeviceImage> textures_;
  DeviceImage white_;
  std::vector<Draw> draws_;
  const RasterPipeline& pipeline(const ShaderDefines& defines, size_t targets);
  Device& device_;
  std::map<ShaderDefines, RasterPipeline> pipelines_;
  uint64_t triangles_ = 0;
  size_t still_draws_ = 0;  // of draws_, the first
};

}  // namespace vsglbench
