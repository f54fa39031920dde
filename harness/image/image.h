// Float images on the host.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace vsglbench {

// Linear Rec.709 radiance, row-major, first row first.
struct Image {
  uint32_t width = 0, height = 0;
  std::vector<glm::vec3> pixels;

  Image() = default;
  Image(uint32_t w, uint32_t h, glm::vec3 fill = glm::vec3(0))
      : width(w), height(h), pixels(size_t(w) * h, fill) {}
  glm::vec3& at(uint32_t x, uint32_t y) { return pixels[size_t(y) * width + x]; }
  const glm::vec3& at(uint32_t x, uint32_t y) const { return pixels[size_t(y) * width + x]; }
};

// Rec.709 luminance.
inline float luminance(const glm::vec3& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

}  // namespace vsglbench
