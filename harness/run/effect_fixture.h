// Tests only: scenes put together triangle by triangle, and the image of what a scene calls for beside that
// of all effects.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "run/laboratory.h"
#include "run/scene_effects.h"
#include "scene/check.h"
#include "scene/mesh.h"
#include "scene/shapes.h"

namespace vsglbench {

// A room that a test fills: everything is Lambertian and white but what is added.
class SceneMaker {
 public:
  SceneMaker() { scene_.name = "made"; }

  uint32_t material(const Material& m) {
    scene_.materials.push_back(m);
    meshes_.emplace_back();
    return static_cast<uint32_t>(meshes_.size() - 1);
  }
  uint32_t lambert(const glm::vec3& color = glm::vec3(0.7f)) {
    Material m;
    m.name = "lambert";
    m.base_color = glm::vec4(color, 1);
    m.specular = 0;
    return material(m);
  }
  int texture(uint32_t width, uint32_t height, bool srgb, std::vector<uint8_t> rgba) {
    scene_.textures.push_back({"made", width, height, srgb, std::move(rgba)});
    return static_cast<int>(scene_.textures.size() - 1);
  }
  // A parallelogram whose uvs run over [0,1]².
  void quad(uint32_t material, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
    Mesh grid;
    add_grid(&grid, corner, u, v, 1, 1, 1);
    for (glm::vec2& uv : grid.uvs) uv = {uv.x / glm::length(u), -uv.y / glm::length(v)};
    place(grid, 0, glm::dvec3(0), &meshes_[material]);
  }
  Mesh& mesh(uint32_t material) { return meshes_[material]; }

  void spot(const glm::vec3& position, const glm::vec3& target, float degrees, float intensity = 20) {
    scene_.light.position = position;
    aim(target - position, &scene_.light.direction, &scene_.light.up);
    scene_.light.fov = glm::radians(degrees);
    scene_.light.power = glm::vec3(intensity);
  }
  void camera(const glm::vec3& position, const glm::vec3& target, float degrees) {
    scene_.camera.position = position;
    aim(target - position, &scene_.camera.direction, &scene_.camera.up);
    scene_.camera.vfov = glm::radians(degrees);
  }

  Scene finish() {
    MeshCollector collector(&scene_);
    for (uint32_t i = 0; i < meshes_.size(); ++i)
      if (!meshes_[i].triangles.empty()) collector.add(std::move(meshes_[i]), i);
    collector.finish();
    scene_.light.position -= glm::vec3(scene_.origin);
    scene_.camera.position -= glm::vec3(scene_.origin);
    check_scene(scene_);
    scene_.hash = scene_hash(scene_);
    return std::move(scene_);
  }

 private:
  static void aim(const glm::vec3& along, glm::vec3* direction, glm::vec3* up) {
    *direction = glm::normalize(along);
    const glm::vec3 side = std::abs(direction->y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    *up = glm::normalize(side - glm::dot(side, *direction) * *direction);
  }
  Scene scene_;
  std::vector<Mesh> meshes_;
};

// What a scene calls for, in the shape of the laboratory's images.
inline std::vector<EffectDecision> decisions_of(const Scene& scene) {
  return derive_effects(scene, float(Laboratory::kWidth) / Laboratory::kHeight);
}

inline bool needs(const Scene& scene, Effect effect) { return needed(decisions_of(scene)).has(effect); }

// The largest |a - b| / |b| over the pixels. A pixel darker than a hundredth of the mean, or than `black`, is
// measured against that: where all light is the far end of a Gaussian, e^-100, its exponent's rounding shows.
inline double relative_difference(const Image& a, const Image& b, double black) {
  double mean = 0, most = 0;
  for (const glm::vec3& p : b.pixels) mean += glm::length(glm::dvec3(p)) / double(b.pixels.size());
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const double size = std::max({glm::length(glm::dvec3(b.pixels[i])), 1e-2 * mean, black});
    most = std::max(most, glm::length(glm::dvec3(a.pixels[i]) - glm::dvec3(b.pixels[i])) / size);
  }
  return most;
}
// A ten-millionth of the light's own intensity or irradiance.
inline double black_of(const Scene& scene) { return 1e-7 * glm::length(scene.light.power); }

struct Forced {
  Image derived, all;
  double difference;
};

// A frame of `lab` by what its scene calls for, and by all effects.
inline Forced with_and_without(Laboratory& lab, const std::string& method, FrameParameters p,
                               const Json& own = Json::object()) {
  SceneEffects effects(lab.scene);
  p.width = Laboratory::kWidth;
  p.height = Laboratory::kHeight;
  p.effects = effects.of(p);
  Forced out;
  out.derived = lab.render(method, own, p);
  p.effects = EffectSet::all();
  out.all = lab.render(method, own, p);
  out.difference = relative_difference(out.derived, out.all, black_of(lab.scene));
  return out;
}

constexpr double kEqual = 1e-5;  // relative, per pixel
inline const FrameParameters kSmall{.rsm = 64, .lights = 64, .visibility = Visibility::none};

inline void expect_equal(Laboratory& lab, const std::string& method, const FrameParameters& p,
                         const Json& own = Json::object()) {
  const Forced images = with_and_without(lab, method, p, own);
  std::printf("%s %s: %.2g\n", lab.scene.name.c_str(), method.c_str(), images.difference);
  EXPECT_LT(images.difference, kEqual) << lab.scene.name << ", " << method;
  const Health health = check_health(images.derived);
  EXPECT_TRUE(health.finite());
}

}  // namespace vsglbench
