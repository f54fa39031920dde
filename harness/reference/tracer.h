// Rays against the scene's triangles (Embree 3): closest hit, occlusion of a segment, packets.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "reference/ray_tree.h"
#include "scene/scene.h"

namespace vsglbench {

class Tracer {
 public:
  // Builds the acceleration structure; keeps a reference to `scene`, which must not change while the
  // tracer lives but by set_frame(), after which update() is due. Alpha-masked texels are holes for every
  // ray. `device_config` is Embree's own configuration string (tests force an instruction set with it).
  // Throws Error(scene).
  explicit Tracer(const Scene& scene, const std::string& device_config = "");
  explicit Tracer(Scene&&, const std::string& = "") = delete;
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  // Takes over what set_frame() moved. The tree over what stands still stays as it is; that over the moving
  // objects is refitted. Every hit is then that of a new tracer of the same pose, to the bit, but that a ray
  // which meets an edge between triangles of an object may be given to either. Error(scene).
  void update(const Moved& moved);

  const Scene& scene() const { return scene_; }
  // Of what stands still.
  RTCScene handle() const { return still_->handle(); }

  // The closest triangle along origin + t direction, `start` < t <= `end`.
  std::optional<Hit> intersect(const glm::vec3& origin, const glm::vec3& direction, float start = 0,
                               float end = std::numeric_limits<float>::infinity()) const;

  // Whether anything lies on the open segment from a to b. Ends on a surface must be offset() first.
  bool occluded(const glm::vec3& a, const glm::vec3& b) const;

  // Bit i: lane i is blocked. Lanes that are off give 0. The lanes should be neighbours.
  uint32_t occluded(const SegmentPacket& packet) const;

  // Lanes that one native packet of this machine traces: 16 (AVX-512), 8 (AVX) or 4; 1 if none.
  int native_width() const { return native_width_; }

  // `point`, on a surface, moved off it along `normal` (the face's, turned to the side the ray leaves).
  // The step is 2^-16 max(|x|, |y|, |z|, diagonal/8): a position interpolated in fp32 errs by about
  // 2^-23 of its largest coordinate and Embree's edge tests by as much of the scene's extent, so this
  // clears both by two decades; 15 um in a room of a metre, 1.5 mm at 100 m from the scene's origin.
  glm::vec3 offset(const glm::vec3& point, const glm::vec3& normal) const;
  float epsilon(const glm::vec3& point) const;

 private:
  void check_embree(const char* what) const;

  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  };

  const Scene& scene_;
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RayTree> still_, moving_;  // moving_: nothing where no object moves
  int native_width_ = 1;
  float least_extent_ = 0;
};

}  // namespace vsglbench
