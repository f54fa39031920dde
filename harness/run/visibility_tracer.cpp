#include "run/visibility_tracer.h"

#include "base/error.h"
#include "measure/stopwatch.h"

namespace vsglbench {

std::vector<uint32_t> VisibilityTracer::trace(const Frame& frame, const std::vector<LightPoint>& lights) {
  const Stopwatch watch;
  std::vector<TargetPoint> targets;
  for (size_t i = 0; i < lights.size(); ++i) targets.push_back(target_of(lights[i], i));
  auto bits =
      compute_visibility(tracer_, receivers_of(frame), frame.camera().width, frame.camera().height, targets);
  wall_->visibility_s += watch.seconds();
  return std::move(bits.words);
}

TargetPoint VisibilityTracer::target_of(const LightPoint& light, size_t index) const {
  const Scene& scene = tracer_.scene();
  const glm::vec3 offset = light.position - 0.5f * (scene.bounds_min + scene.bounds_max);
  // Both comparisons are false for a NaN. A position is a mean of surface points, so it lies within the
  // bounds.
  const bool somewhere = glm::length(offset) <= 1e3f * scene.diagonal();
  const bool short_enough = light.stop_short >= 0 && light.stop_short <= 1e3f * scene.diagonal();
  if (somewhere && short_enough) return {light.position, light.stop_short};
  throw fail(ErrorKind::case_failed,
             "light {} of pass generate.rsm stands at ({}, {}, {}), radius {}: not a place in the scene",
             index, light.position.x, light.position.y, light.position.z, light.stop_short);
}

const std::vector<ReceiverPoint>& VisibilityTracer::receivers_of(const Frame& frame) {
  auto& points = receivers_[{frame.camera().width, frame.camera().height, frame.effects()}];
  if (!points.empty()) return points;
  const auto position = download_map(frame.gbuffer().maps[0]);
  const auto normal = download_map(frame.gbuffer().geometric_normals());
  // A pixel on the very edge between two walls may lie behind the other wall by rounding: a step towards the
  // eye, whose view of the point is free, brings it back.
  for (size_t i = 0; i < position.size(); ++i) {
    const glm::vec3 p(position[i]);
    const glm::vec3 to_eye = glm::normalize(frame.camera().position - p);
    points.push_back({p + 4 * tracer_.epsilon(p) * to_eye, glm::vec3(normal[i]), position[i].w > 0});
  }
  return points;
}

}  // namespace vsglbench
