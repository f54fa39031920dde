#include "scene/view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vsglbench {
namespace {

Light spot() {
  Light light;
  light.position = {1, 2, 3};
  light.direction = glm::normalize(glm::vec3(1, -2, 0.5f));
  light.up = glm::normalize(glm::cross(glm::cross(light.direction, glm::vec3(0, 1, 0)), light.direction));
  light.fov = 1.2f;
  light.near = 0.5f;
  light.far = 50;
  light.power = {10, 20, 30};
  return light;
}

Light sun() {
  Light light = spot();
  light.type = Light::Type::directional;
  light.half_extent = {3, 2};
  return light;
}

Camera camera() {
  Camera c;
  c.position = {-4, 1, 2};
  c.direction = glm::normalize(glm::vec3(1, 0.2f, -0.3f));
  c.up = glm::normalize(glm::cross(glm::cross(c.direction, glm::vec3(0, 1, 0)), c.direction));
  c.near = 0.1f;
  c.far = 30;
  return c;
}

std::vector<View> views() { return {light_view(spot()), light_view(sun()), camera_view(camera(), 480, 272)}; }

TEST(View, RayAndProjectAreInverse) {
  for (const View& view : views()) {
    for (const glm::vec2 uv : {glm::vec2(0.5f, 0.5f), glm::vec2(0.1f, 0.9f), glm::vec2(0.99f, 0.02f)}) {
      glm::vec3 origin, direction;
      view.ray(uv, &origin, &direction);
      EXPECT_NEAR(glm::length(direction), 1, 1e-6);
      const auto back = view.project(origin + 7.5f * direction);
      ASSERT_TRUE(back.has_value());
      EXPECT_NEAR(back->x, uv.x, 1e-5);
      EXPECT_NEAR(back->y, uv.y, 1e-5);
    }
  }
}

TEST(View, ImageOriginIsTopLeft) {
  for (const View& view : views()) {
    const auto uv = view.project(view.position + 10.0f * view.forward + 0.5f * view.right + 0.25f * view.up);
    ASSERT_TRUE(uv.has_value());
    EXPECT_GT(uv->x, 0.5f);
    EXPECT_LT(uv->y, 0.5f);
  }
}

TEST(View, NothingOutsideOrBehind) {
  for (const View& view : views()) {
    EXPECT_FALSE(view.project(view.position + view.forward + 100.0f * view.right));
    EXPECT_EQ(view.image_density(view.position + view.forward + 100.0f * view.right, view.forward), 0);
    if (view.perspective) {
      EXPECT_FALSE(view.project(view.position - view.forward));
    }
  }
}

// Clip space must agree with project(), and take near and far to depths 0 and 1.
TEST(View, ViewProjectionAgreesWithProject) {
  for (const View& view : views()) {
    const glm::mat4 m = view.view_projection();
    for (const float depth : {view.near, 0.5f * (view.near + view.far), view.far}) {
      const float spread = view.perspective ? depth : 1.0f;
      const glm::vec3 p = view.position + depth * view.forward + 0.3f * spread * view.extent.x * view.right -
                          0.6f * spread * view.extent.y * view.up;
      const glm::vec4 clip = m * glm::vec4(p, 1);
      const auto uv = view.project(p);
      ASSERT_TRUE(uv.has_value());
      EXPECT_NEAR(0.5f + 0.5f * clip.x / clip.w, uv->x, 1e-5);
      EXPECT_NEAR(0.5f + 0.5f * clip.y / clip.w, uv->y, 1e-5);
      if (depth == view.near) {
        EXPECT_NEAR(clip.z / clip.w, 0, 1e-4);
      }
      if (depth == view.far) {
        EXPECT_NEAR(clip.z / clip.w, 1, 1e-5);
      }
    }
  }
}

// The image area of a small patch, projected corner by corner, is density times its area.
TEST(View, ImageDensityIsTheJacobian) {
  for (const View& view : views()) {
    glm::vec3 origin, direction;
    view.ray({0.3f, 0.7f}, &origin, &direction);
    const glm::vec3 p = origin + 4.0f * direction;
    const glm::vec3 n = glm::normalize(glm::vec3(0.3f, 1, 0.2f));
    const glm::vec3 a = glm::normalize(glm::cross(n, glm::vec3(1, 0, 0))), b = glm::cross(n, a);
    const float h = 0.01f;
    const glm::vec2 du = *view.project(p + h * a) - *view.project(p - h * a);
    const glm::vec2 dv = *view.project(p + h * b) - *view.project(p - h * b);
    const double numeric = std::abs(du.x * dv.y - du.y * dv.x) / (4.0 * h * h);
    EXPECT_NEAR(view.image_density(p, n) / numeric, 1, 1e-3);
  }
}

// A plane across the view: density over the part in view integrates to the whole image.
TEST(View, ImageDensityIntegratesToOne) {
  for (const View& view : views()) {
    const glm::vec3 normal = glm::normalize(-view.forward + 0.3f * view.right);
    const glm::vec3 centre = view.position + 5.0f * view.forward;
    const glm::vec3 a = glm::normalize(glm::cross(normal, view.up)), b = glm::cross(normal, a);
    constexpr int kSteps = 1500;
    constexpr double kHalf = 12, kStep = 2 * kHalf / kSteps;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps; ++j) {
        const float x = static_cast<float>((i + 0.5) * kStep - kHalf),
                    y = static_cast<float>((j + 0.5) * kStep - kHalf);
        sum += view.image_density(centre + x * a + y * b, normal) * kStep * kStep;
      }
    }
    EXPECT_NEAR(sum, 1, 5e-3);
  }
}

TEST(View, FluxDensityIntegratesToTheFrustumsFlux) {
  for (const Light& light : {spot(), sun()}) {
    constexpr int kTexels = 256;
    glm::dvec3 sum(0);
    for (int y = 0; y < kTexels; ++y) {
      for (int x = 0; x < kTexels; ++x) {
        sum += flux_density(light, {(x + 0.5f) / kTexels, (y + 0.5f) / kTexels}) / double(kTexels * kTexels);
      }
    }
    const glm::dvec3 exact = frustum_flux(light);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k] / exact[k], 1, 1e-4);
  }
}

// A cube's face seen from its centre is a sixth of the sphere.
TEST(View, NinetyDegreeFrustumIsASixthOfTheSphere) {
  Light light = spot();
  light.fov = static_cast<float>(std::acos(0.0));
  light.power = glm::vec3(1);
  EXPECT_NEAR(frustum_flux(light).x, 4 * std::acos(-1.0) / 6, 1e-6);
}

}  // namespace
}  // namespace vsglbench
