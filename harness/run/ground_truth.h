// What whole frames need beside the device: the scene in the ray tracer.
#pragma once

#include "measure/stopwatch.h"
#include "run/references.h"
#include "run/visibility_tracer.h"

namespace vsglbench {

struct GroundTruth {
  GroundTruth(const Scene& scene, const Config& config, WallTime* wall)
      : tracer(timed_tracer(scene, wall)), references(scene, config, wall), visibility(tracer, wall) {}
  Tracer tracer;
  References references;
  VisibilityTracer visibility;

 private:
  static Tracer timed_tracer(const Scene& scene, WallTime* wall) {
    struct Timer {
      WallTime* wall;
      Stopwatch watch;
      ~Timer() { wall->references_s += watch.seconds(); }
    } timer{wall, {}};
    return Tracer(scene);
  }
};

}  // namespace vsglbench
