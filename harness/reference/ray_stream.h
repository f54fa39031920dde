// One worker's rays: counted, and logged where their replay is to be timed.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/tracer.h"

namespace vsglbench {

struct LoggedRay {
  glm::vec3 origin, direction;
  float start, end;
  bool shadow;  // any hit in [0, 1] of the direction, else the closest
};
using RayLog = std::vector<LoggedRay>;

// Aligned so that threads' counters share no cache line.
class alignas(128) RayStream {
 public:
  explicit RayStream(const Tracer& tracer, RayLog* log = nullptr) : tracer_(&tracer), log_(log) {}

  const Tracer& tracer() const { return *tracer_; }
  uint64_t rays() const { return rays_; }

  std::optional<Hit> intersect(const glm::vec3& origin, const glm::vec3& direction, float start = 0) {
    constexpr float end = std::numeric_limits<float>::infinity();
    ++rays_;
    if (log_) log_->push_back({origin, direction, start, end, false});
    return tracer_->intersect(origin, direction, start, end);
  }

  bool occluded(const glm::vec3& a, const glm::vec3& b) {
    ++rays_;
    if (log_) log_->push_back({a, b - a, 0, 1, true});
    return tracer_->occluded(a, b);
  }

  // Which lanes of a packet are occluded, as bits; lanes that are off are no rays.
  uint32_t occluded(const SegmentPacket& packet) {
    for (int i = 0; i < SegmentPacket::width; ++i) rays_ += packet.end[i] >= 0;
    if (log_) log_lanes(packet);
    return tracer_->occluded(packet);
  }

 private:
  void log_lanes(const SegmentPacket& p) {
    for (int i = 0; i < SegmentPacket::width; ++i) {
      if (p.end[i] < 0) continue;
      log_->push_back({{p.origin[0][i], p.origin[1][i], p.origin[2][i]},
                       {p.direction[0][i], p.direction[1][i], p.direction[2][i]},
                       0,
                       p.end[i],
                       true});
    }
  }

  const Tracer* tracer_;
  RayLog* log_;
  uint64_t rays_ = 0;
};

}  // namespace vsglbench
