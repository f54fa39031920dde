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

 private:
  const Tracer* tracer_;
  RayLog* log_;
  uint64_t rays_ = 0;
};

}  // namespace vsglbench
