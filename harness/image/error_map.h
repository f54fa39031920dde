// Where an image is too bright or too dark: signed relative error per pixel, and its colours.
#pragma once

#include "image/metrics.h"
#include "image/png.h"

namespace vsglbench {

// (x−r) / ((|x|+|r|)/2) of luminance, −2 … 2, in all three channels; 0/0 and masked pixels give 0, a NaN or
// Inf in either image gives NaN. Throws Error(case_failed) when sizes differ.
Image error_map(const Image& x, const Image& r, const Mask& mask = {});

// Diverging colours of t in −1 … 1 (clamped): pale blue, blue, near-black at 0, red, pale yellow. Lightness
// grows with |t|, so that a correct image is dark and an error stands out.
glm::u8vec3 diverging_color(float t);

// error_map's first channel in diverging_color(error / range); masked pixels grey, NaN magenta.
Bitmap color_error_map(const Image& error, float range, const Mask& mask = {});

}  // namespace vsglbench
