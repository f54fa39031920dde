// Tests only: whole frames of one scene beside its references, without reports and processes.
#pragma once

#include <map>
#include <optional>

#include "base/file.h"
#include "frame/frame.h"
#include "image/metrics.h"
#include "method/registry.h"
#include "reference/reference.h"
#include "reference/visibility.h"
#include "scene/scene_file.h"

namespace vsglbench {

// One scene, its device data and its references, shared by the tests of a file.
class Laboratory {
 public:
  static constexpr uint32_t kWidth = 96, kHeight = 54;

  explicit Laboratory(const std::string& name) : Laboratory(load_scene(name, {data_root() / "scenes", {}})) {}
  explicit Laboratory(Scene made)
      : scene(std::move(made)), tracer(scene), kernels(device()), stage(device(), kernels, scene) {}

  static Device& device() {
    static Device d;
    return d;
  }

  Image render(const std::string& method, const Json& own, uint32_t rsm, uint32_t lights,
               Visibility visibility) {
    return render(method, own, {.rsm = rsm, .lights = lights, .visibility = visibility});
  }
  // A frame of width × height pixels and importance_lights, whatever `p` says. The members below that are
  // not const tell what the last frame left.
  Image render(const std::string& method, const Json& own, FrameParameters p, uint32_t seed = 0) {
    p.width = width;
    p.height = height;
    p.importance_lights = importance_lights;
    const MethodInfo& info = load_method(method, device().info());
    Frame* self = nullptr;
    Frame frame(stage, info, resolve_parameters(info, own), p,
                [&](const std::vector<LightPoint>& points) { return bits(*self, points); });
    self = &frame;
    frame.render(seed);
    notes = frame.results().shading_notes();
    mask = frame.results().surface_mask();
    importance = frame.results().importance();
    camera = frame.camera();
    light = frame.light();
    return frame.results().indirect();
  }

  const ReferenceResult& reference(bool occlusion) {
    auto& slot = references_[occlusion];
    if (!slot) {
      slot = compute_reference(tracer,
                               {.width = kWidth, .height = kHeight, .samples = 2048, .occlusion = occlusion});
    }
    return *slot;
  }

  Errors against_reference(const Image& image, bool occlusion) {
    const auto& r = reference(occlusion);
    Mask both = mask;
    for (size_t i = 0; i < both.size(); ++i) both[i] = both[i] && r.mask[i];
    return measure_errors(image, r.mean, both);
  }

  const Scene scene;
  const Tracer tracer;
  KernelLibrary kernels;
  Stage stage;
  uint32_t width = kWidth, height = kHeight;  // of frames; references are kWidth × kHeight
  uint32_t importance_lights = 256;
  Mask mask;
  ShadingNotes notes;
  std::vector<float> importance;  // as FrameReadback::importance()
  gpu::Emitter camera, light;

 private:
  std::vector<uint32_t> bits(Frame& frame, const std::vector<LightPoint>& points) {
    const auto position = download_map(frame.gbuffer().maps[0]),
               normal = download_map(frame.gbuffer().geometric_normals());
    std::vector<ReceiverPoint> receivers;
    for (size_t i = 0; i < position.size(); ++i) {
      receivers.push_back({glm::vec3(position[i]), glm::vec3(normal[i]), position[i].w > 0});
    }
    std::vector<TargetPoint> targets;
    for (const auto& p : points) targets.push_back({p.position, p.stop_short});
    return compute_visibility(tracer, receivers, width, height, targets).words;
  }
  std::map<bool, std::optional<ReferenceResult>> references_;
};

}  // namespace vsglbench
