// One Embree tree over some of a scene's triangles.
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "scene/scene.h"

namespace vsglbench {

struct Hit {
  float distance = 0;        // in units of |direction|
  uint32_t triangle = 0;     // index into Scene::triangles
  glm::vec2 barycentric{0};  // weights of the triangle's second and third vertex
  glm::vec3 face_normal{0};  // of any length, on either side
};

// 16 segments, structure of arrays: origin + t direction for t in [0, end]. A lane with end < 0 is off.
struct alignas(64) SegmentPacket {
  static constexpr int width = 16;
  float origin[3][width], direction[3][width], end[width];
};

class RayTree {
 public:
  // What stands still, built once and well, or the moving objects, whose tree is refitted as they move. Keeps
  // a reference to `scene`.
  enum class Part { still, moving };
  RayTree(RTCDevice device, const Scene& scene, Part part);
  ~RayTree();
  RayTree(const RayTree&) = delete;
  RayTree& operator=(const RayTree&) = delete;

  RTCScene handle() const { return rtc_.get(); }

  // Takes the present positions of objects (indices into Animation::objects) over from the scene.
  void update(const std::vector<uint32_t>& objects);

  // The closest triangle along origin + t direction, `start` < t <= `end`.
  std::optional<Hit> intersect(const glm::vec3& origin, const glm::vec3& direction, float start,
                               float end) const;
  // Whether anything lies on the open segment from a to b.
  bool occluded(const glm::vec3& a, const glm::vec3& b) const;
  // Bit i: lane i is blocked. Lanes that are off or in `skip` give 0. `native_width` lanes are traced at a
  // time.
  uint32_t occluded(const SegmentPacket& packet, int native_width, uint32_t skip) const;

 private:
  struct Group;  // triangles of one Embree geometry
  void add_still();
  void add_moving();
  void attach(unsigned id);
  void copy_positions(const Group& group, void* vertices) const;

  struct Release {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };

  RTCDevice device_;
  const Scene& scene_;
  bool moves_;
  std::unique_ptr<RTCSceneTy, Release> rtc_;
  bool direct_ = false;                         // one geometry, whose indices are the scene's
  std::vector<std::unique_ptr<Group>> groups_;  // by Embree's geometry id
};

}  // namespace vsglbench
