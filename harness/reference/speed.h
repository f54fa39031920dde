// What the reference's own work costs beside tracing: its rays, replayed without it.
#pragma once

#include "reference/reference.h"

namespace vsglbench {

struct SpeedRatio {
  uint64_t rays = 0;
  double reference_seconds = 0, bare_seconds = 0;  // medians of `repeats` interleaved runs
  double ratio() const { return bare_seconds / reference_seconds; }
};

// Runs a small reference (parameters: width, height, samples, seed), logs every ray it traces, then
// times the same reference without the log against a bare Embree loop over those rays: in the same order, on
// as many threads, one call a ray, also of those that the reference traces 16 at a time. ratio() = reference
// rays/s over bare rays/s.
SpeedRatio measure_speed_ratio(const Scene& scene, const ReferenceParameters& parameters, int repeats = 3);
double reference_speed_ratio(const Scene& scene, const ReferenceParameters& parameters);

}  // namespace vsglbench
