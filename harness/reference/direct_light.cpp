#include "reference/direct_light.h"

#include "base/parallel.h"
#include "reference/brdf.h"
#include "scene/view.h"

namespace vsglbench {
namespace {

// Radiance towards the viewer of a surface that nothing shadows.
glm::vec3 unshadowed(const Light& light, const View& lamp, const Surface& s, const glm::vec3& to_viewer) {
  if (!lamp.project(s.position)) return glm::vec3(0);
  const glm::vec3 way = lamp.position - s.position;
  const glm::vec3 to_light = lamp.perspective ? glm::normalize(way) : -lamp.forward;
  const float cosine = glm::dot(s.normal, to_light);
  if (!(cosine > 0)) return glm::vec3(0);
  return light.power * Brdf(s, to_viewer).f(to_light) *
         (cosine / (lamp.perspective ? glm::dot(way, way) : 1));
}

}  // namespace

DirectLight direct_light(const Tracer& tracer, uint32_t width, uint32_t height, unsigned threads) {
  const Scene& scene = tracer.scene();
  const View camera = camera_view(scene.camera, width, height), lamp = light_view(scene.light);
  DirectLight out{Image(width, height), std::vector<uint8_t>(size_t(width) * height)};
  parallel_for(height, threads, [&](uint64_t row, unsigned) {
    const auto y = static_cast<uint32_t>(row);
    for (uint32_t x = 0; x < width; ++x) {
      glm::vec3 eye, direction;
      camera.ray((glm::vec2(x, y) + 0.5f) / glm::vec2(width, height), &eye, &direction);
      const auto hit = tracer.intersect(eye, direction);
      if (!hit) continue;
      out.mask[row * width + x] = 1;
      const Surface s = surface_at(scene, hit->triangle, hit->barycentric, -direction);
      const glm::vec3 radiance = unshadowed(scene.light, lamp, s, -direction);
      if (radiance == glm::vec3(0)) continue;
      // A sun's ray starts on its rectangle.
      const glm::vec3 source =
          lamp.perspective ? lamp.position
                           : s.position - glm::dot(s.position - lamp.position, lamp.forward) * lamp.forward;
      const bool lit_side = glm::dot(s.geometric_normal, source - s.position) > 0;
      if (lit_side && !tracer.occluded(tracer.offset(s.position, s.geometric_normal), source))
        out.image.at(x, y) = radiance;
    }
  });
  return out;
}

}  // namespace vsglbench
