// HDR-FLIP: how different two images look when one flips back and forth between them, at every exposure that
// shows something.
// Sources: Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images"; Andersson et al.
// 2021, "Visualizing Errors in Rendered High Dynamic Range Images".
#pragma once

#include <optional>
#include <vector>

#include "image/flip_filter.h"
#include "image/metrics.h"

namespace vsglbench {

// The papers' viewer: a display 0.7 m wide of 3840 pixels, 0.7 m away; 67.02.
inline constexpr double kFlipPixelsPerDegree = 3840 * 3.14159265358979323846 / 180;

// Powers of two, evenly spaced from the start (the brightest pixel just below white) to the stop (dark pixels
// as bright).
struct FlipExposures {
  double start = 0, stop = 0;
  uint32_t count = 2;
  double exposure(uint32_t i) const { return start + (stop - start) * i / (count - 1); }
};

// The published rule: start and stop take the largest and the median luminance of the reference to where the
// tone curve reaches 0.85; max(2, ⌈stop − start⌉) exposures. Where the median is not above 0 there is no such
// stop; ours then takes the median of the luminances above 0 instead, and at most kFlipMostStops beyond
// start. Over the pixels that the mask keeps. Nothing for a black reference.
inline constexpr double kFlipMostStops = 16;
std::optional<FlipExposures> flip_exposures(const Image& r, const Mask& mask = {});

struct FlipErrors {
  double mean = 0, p99 = 0;  // over the pixels that the mask keeps, 0 … 1
  FlipExposures exposures;
};

// A reference as FLIP sees it, at every exposure, for comparing many images with it.
class FlipReference {
 public:
  // Pixels that the mask leaves out are black in both images and no part of the mean. `r` is finite.
  FlipReference(const Image& r, const Mask& mask, const FlipExposures& exposures);
  // Throws as measure_errors does.
  FlipErrors compare(const Image& x) const;
  // The largest error of all exposures at every pixel.
  Plane error_map(const Image& x) const;

 private:
  struct View {  // of one image at one exposure
    std::vector<glm::vec3> hunt_lab;
    Features features;
  };
  View view(const Image& image, double exposure) const;
  template <class Work>
  void at_every_exposure(const Work& work) const;

  Image reference_;
  Mask mask_;
  FlipExposures exposures_;
  Sensitivity achromatic_, red_green_, blue_yellow_;
  std::vector<View> views_;  // of the reference; none where they would take too much memory
};

// Nothing for a black reference. Throws as measure_errors does.
std::optional<FlipErrors> measure_flip(const Image& x, const Image& r, const Mask& mask = {});

}  // namespace vsglbench
