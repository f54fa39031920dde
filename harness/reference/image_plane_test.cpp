#include "reference/image_plane.h"

#include <gtest/gtest.h>

#include "reference/random.h"
#include "reference/test_scenes.h"

namespace vsglbench {
namespace {

// The single-precision copies say what scene/view.h says.
TEST(ImagePlane, AgreesWithView) {
  Light sun = test::spot({0.5f, 3, 0.2f}, {0.3f, -1, 0.4f}, 1);
  sun.type = Light::Type::directional;
  sun.half_extent = {1.5f, 0.7f};
  const Camera camera = test::camera_at({1, 2, 3}, {0, 0, 0.3f}, 0.9f);
  int inside = 0;
  for (const View& view : {light_view(sun), light_view(test::spot({0.5f, 3, 0.2f}, {0.3f, -1, 0.4f}, 1)),
                           camera_view(camera, 480, 272)}) {
    const ImagePlane plane(view);
    for (uint32_t i = 0; i < 1000; ++i) {
      const glm::vec3 p =
          view.position + 3.0f * view.forward + 4.0f * (glm::vec3(random4(1, Stream::light, 0, i)) - 0.5f);
      const glm::vec3 n = glm::normalize(glm::vec3(random4(2, Stream::light, 0, i)) - 0.5f);
      const auto uv = plane.project(p), want = view.project(p);
      if (!uv || !want) {
        EXPECT_EQ(uv.has_value(), want.has_value());
        continue;
      }
      ++inside;
      EXPECT_NEAR(uv->x, want->x, 1e-5f);
      EXPECT_NEAR(uv->y, want->y, 1e-5f);
      glm::vec3 origin, direction;
      view.ray(*want, &origin, &direction);
      EXPECT_LT(glm::distance(plane.origin(p), origin), 1e-5f);
      const float density =
          plane.facing_density(direction, glm::distance(p, origin)) * std::abs(glm::dot(n, direction));
      EXPECT_NEAR(density, view.image_density(p, n), 1e-4 * density);
    }
  }
  EXPECT_GT(inside, 300);
}

}  // namespace
}  // namespace vsglbench
