// How much of the reference's detail an image keeps: the other side of flicker in [MFIS16 Fig. 6], where a
// kernel K times as large "improves the temporal coherence, while some illumination appearance is
// overblurred".
#pragma once

#include <optional>

#include "image/metrics.h"

namespace vsglbench {

// What reports call "detail": "gradient-slope-over-gain".
const MetricFormula& detail_formula();

struct Detail {
  double value = 0;  // slope / gain: 1 as sharp as the reference, below 1 blurred, above 1 sharper
  double slope = 0;  // Σ ∇x·∇r / Σ ∇r·∇r
  double gain = 0;   // mean(x) / mean(r)
};

// The slope of a regression of x's gradients on those of r, so that noise and spikes in x, whose gradients
// have nothing to do with r's, scatter it (the more the higher they are) but do not raise it, as they would a
// ratio of energies; divided by what x is brighter by. Gradients are differences of horizontal and of
// vertical neighbours, both in the mask, per channel; all sums run over all frames.
//
// Noise in r would lower it: Σ ∇r·∇r holds the noise's energy, which x has no part in. So r comes as the
// means a and b of two independent halves of its samples (r = (a+b)/2), and Σ ∇a·∇b stands for Σ ∇r·∇r.
// Without noise a and b are the same image.
//
// Pixels are neighbours here, and gradients grow with frequency: what is finest in r counts most, among it
// edges of geometry and textures, which every method keeps. The value says which of two methods blurs more in
// one scene; it is no ratio of widths.
class DetailMeter {
 public:
  // The next frame. Throws Error(case_failed) as measure_errors does (sizes, a NaN or Inf in x, a or b).
  void add(const Image& x, const Image& half0, const Image& half1, const Mask& mask = {});
  // Of all frames so far. Nothing where there is no slope to tell: r is flat or its gradients are noise
  // (Σ ∇a·∇b is not above 0), or mean(x) or mean(r) is not above 0.
  std::optional<Detail> finish() const;

 private:
  double test_ = 0, reference_ = 0;  // Σ ∇x·∇r and Σ ∇a·∇b
  double sum_x_ = 0, sum_r_ = 0;
};

}  // namespace vsglbench
