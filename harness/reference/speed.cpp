#include "reference/speed.h"

#include <algorithm>
#include <chrono>

#include "base/parallel.h"

namespace vsglbench {
namespace {

RTCRayHit embree_ray(const LoggedRay& ray) {
  RTCRayHit r;
  r.ray = {ray.origin.x,    ray.origin.y, ray.origin.z, ray.start, ray.direction.x, ray.direction.y,
           ray.direction.z, 0 /* time */, ray.end,      ~0u,       0 /* id */,      0 /* flags */};
  r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return r;
}

// Embree and nothing else: each thread traces its own log.
double replay(const Tracer& tracer, const std::vector<RayLog>& logs) {
  const auto start = std::chrono::steady_clock::now();
  parallel_for(logs.size(), static_cast<unsigned>(logs.size()), [&](uint64_t i, unsigned) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (const LoggedRay& ray : logs[i]) {
      RTCRayHit r = embree_ray(ray);
      if (ray.shadow) {
        rtcOccluded1(tracer.handle(), &context, &r.ray);
      } else {
        rtcIntersect1(tracer.handle(), &context, &r);
      }
    }
  });
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

SpeedRatio measure_speed_ratio(const Scene& scene, const ReferenceParameters& parameters, int repeats) {
  const Tracer tracer(scene);
  std::vector<RayLog> logs;
  SpeedRatio speed;
  speed.rays = compute_reference(tracer, parameters, &logs).rays;
  std::vector<double> reference, bare;
  for (int i = 0; i < std::max(repeats, 1); ++i) {
    reference.push_back(compute_reference(tracer, parameters).seconds);
    bare.push_back(replay(tracer, logs));
  }
  speed.reference_seconds = median(reference);
  speed.bare_seconds = median(bare);
  return speed;
}

double reference_speed_ratio(const Scene& scene, const ReferenceParameters& parameters) {
  return measure_speed_ratio(scene, parameters).ratio();
}

}  // namespace vsglbench
