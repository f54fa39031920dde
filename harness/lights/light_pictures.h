// Pictures of a case's lights: over the RSM [MFIS16 Fig. 1] and in the scene [VSGL14 Fig. 2].
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/image.h"
#include "image/png.h"
#include "lights/coverage.h"
#include "lights/light_list.h"
#include "scene/view.h"

namespace vsglbench {

// A light as the pictures need it.
struct LightMark {
  uint32_t index = 0;     // in the set
  glm::vec3 position{0};  // m
  float sigma = 0;        // m; 0: a point
  glm::vec3 color{0};     // of the flux that it reflects, largest channel 1
  float power = 0;        // luminance, W
};

// Those of power above 0.
std::vector<LightMark> light_marks(const LightSet& lights);

// Brightness is the square root of p over its 99.5th percentile; `fallback` (a value a texel) stands in for
// the PDF where the method uses none. Orange points: centres of the footprints, or where the light's view
// shows the lights' positions. Blue: outlines of the square footprints, or borders of the clusters, which are
// tinted. A texel is as many whole pixels as make about 1024, 16 at most, 1024 pixels in all for an RSM above
// that. `captions` stand above, `coverage` and what the marks mean below.
Bitmap draw_on_rsm(const LightSet& lights, const View& light, const std::vector<float>& fallback,
                   const std::optional<Coverage>& coverage, const std::vector<std::string>& captions);

// What the camera sees: the picture that the lights are drawn on, and each pixel's surface.
struct CameraView {
  View view;
  Image direct;                     // direct light
  std::vector<glm::vec4> position;  // m; w > 0 where there is a surface
  std::vector<glm::vec4> normal;    // xyz
};

// Each light as a disk of its colour with its projected σ for a radius, and a dot at its projected position;
// a faint ring alone where it is hidden: where all surfaces of its pixel and the eight around are nearer to
// the camera by more than σ (and a thousandth of the distance). Of many lights only the strongest have disks
// and rings, the others smaller dots, and weak hidden ones no mark; the indices of the very strongest stand
// beside their dots.
Bitmap draw_in_scene(const LightSet& lights, const CameraView& camera,
                     const std::vector<std::string>& captions);

}  // namespace vsglbench
