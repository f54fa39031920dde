// Where an image is too bright or too dark: signed relative error per pixel, and its colours.
#pragma once

#include "image/metrics.h"
#include "image/png.h"

namespace vsglbench {

// (x−r) / ((|x|+|r|)/2) of luminance, −2 … 2, in all three channels; 0/0 and masked pixels give 0, a NaN or
// Inf in either image gives NaN. Throws Error(case_failed) when sizes differ.
Image error_map(const Image& x, const Image& r, const Mask& mask = {});

// Share of the pixels in the mask whose error is beyond ±range.
double clipped_share(const Image& error, float range, const Mask& mask = {});

// The theme's diverging colours of t in −1 … 1 (clamped): blue where it is too dark, red where it is too
// bright. Dark theme: pale ends round near-black, so that a correct image is dark and an error stands out;
// light theme: dark ends round white.
glm::u8vec3 diverging_color(float t);

// error_map's first channel in diverging_color(error / range); masked pixels grey, NaN magenta.
Bitmap color_error_map(const Image& error, float range, const Mask& mask = {});

}  // namespace vsglbench
