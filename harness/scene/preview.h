// A picture of a scene for who places its camera and light: what the camera sees, and where both stand. Drawn
// by rays, without a device.
#pragma once

#include "image/png.h"
#include "scene/shot.h"

namespace vsglbench {

// Left: the camera's view, `width` pixels wide at 16 to 9, with the light's direct light. Right, as large:
// the scene from a corner above it, cut off above camera and light; yellow what the light sees, blue what the
// camera sees, green what both see, and both frusta. Below: what measure_shot() says.
Bitmap preview_picture(const TriangleTree& tree, uint32_t width = 640);

// "the camera sees 35 % of the lit surface; indirect light reaches 88 % of what it sees": of the tree's
// scene.
std::vector<std::string> shot_notes(const ShotMeasure& measure);

}  // namespace vsglbench
