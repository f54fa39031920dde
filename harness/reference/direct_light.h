// The light that comes straight from the lamp: exact BRDFs, exact shadows. For pictures; no method makes it.
#pragma once

#include "image/image.h"
#include "reference/tracer.h"

namespace vsglbench {

struct DirectLight {
  Image image;                // W/sr/m^2, at the pixel centres towards the eye
  std::vector<uint8_t> mask;  // 1 where the camera sees a surface
};

// threads = 0: all.
DirectLight direct_light(const Tracer& tracer, uint32_t width, uint32_t height, unsigned threads = 0);

}  // namespace vsglbench
