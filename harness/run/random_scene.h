// Tests only: random scenes, of materials × textures × placements.
#pragma once

#include <array>
#include <map>
#include <random>

#include "run/effect_fixture.h"

namespace vsglbench {

class RandomScene {
 public:
  explicit RandomScene(uint32_t seed) : random_(seed) {}

  Scene make() {
    for (int i = 0; i < 3; ++i) materials_.push_back(maker_.material(material()));
    if (chance(0.15)) return facing_walls();
    // 1. Floor and wall, or one of them. 2. Plates anywhere. 3. A round thing.
    const bool floor = chance(0.8);
    if (floor) maker_.quad(any(), {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
    if (!floor || chance(0.7)) maker_.quad(any(), {-2, 0, -2}, {4, 0, 0}, {0, 3, 0});
    for (int i = 0; i < 4; ++i)
      maker_.quad(any(), point(-1.5, 1.5), 0.8 * point(-1, 1) + glm::dvec3(0.3, 0, 0),
                  0.8 * point(-1, 1) + glm::dvec3(0, 0.3, 0));
    if (chance(0.3)) {
      const glm::dvec2 profile[] = {{0.3, 0}, {0.5, 0.5}, {0.2, 1}};
      add_lathe(&maker_.mesh(any()), point(-1, 1), profile, 12, 1);
    }
    maker_.spot(glm::vec3(point(-1, 1)) + glm::vec3(0, 2.5f, 0), glm::vec3(point(-1, 1)), 20 + 60 * real());
    maker_.camera(glm::vec3(point(-1, 1)) + glm::vec3(0, 1, 4), glm::vec3(point(-0.5, 0.5)),
                  25 + 40 * real());
    return maker_.finish();
  }

 private:
  // One is lit, the other seen: nothing hides anything.
  Scene facing_walls() {
    maker_.quad(any(), {-2, 0, 1}, {0, 0, -2}, {0, 2, 0});
    maker_.quad(any(), {2, 0, -1}, {0, 0, 2}, {0, 2, 0});
    maker_.spot({-1, 1, 0}, {-2, 1, 0}, 20 + 60 * real());
    maker_.camera({1, 1, 0}, {2, 1, 0}, 25 + 40 * real());
    return maker_.finish();
  }

  float real() { return static_cast<float>(random_() >> 8) * 0x1p-24f; }
  bool chance(double p) { return real() < p; }
  glm::dvec3 point(double low, double high) {
    const double x = real(), y = real(), z = real();
    return low + (high - low) * glm::dvec3(x, y, z);
  }
  uint32_t any() { return materials_[random_() % materials_.size()]; }

  // Noise, constant, or constant but for one texel.
  int texture(bool srgb) {
    const uint32_t size = 1u << (random_() % 4);
    const int kind = static_cast<int>(random_() % 3);
    std::vector<uint8_t> rgba(size_t(4) * size * size);
    std::array<uint8_t, 4> one{};
    for (uint8_t& v : one) v = static_cast<uint8_t>(chance(0.3) ? 0 : chance(0.5) ? 255 : random_());
    for (size_t i = 0; i < rgba.size(); ++i)
      rgba[i] = kind == 0 ? static_cast<uint8_t>(random_()) : one[i % 4];
    if (kind == 2) rgba[random_() % rgba.size()] = static_cast<uint8_t>(random_());
    return maker_.texture(size, size, srgb, rgba);
  }

  Material material() {
    Material m;
    m.name = "random";
    const float r = real(), g = real(), b = real();
    m.base_color = chance(0.15) ? glm::vec4(0, 0, 0, 1) : glm::vec4(r, g, b, 1);
    m.specular = chance(0.6) ? 0 : real();
    m.metallic = chance(0.5) ? 0 : chance(0.6) ? 1 : real();
    m.roughness = 0.1f + 0.9f * real();
    if (chance(0.15)) m.phong_exponent = 1 + 2000 * real();
    if (chance(0.3)) m.base_color_texture = texture(true);
    if (chance(0.25)) m.metallic_roughness_texture = texture(false);
    if (chance(0.2)) m.normal_texture = texture(false);
    if (chance(0.3)) m.alpha_cutoff = 0.5f;
    return m;
  }

  std::mt19937 random_;
  SceneMaker maker_;
  std::vector<uint32_t> materials_;
};

// What each of the scenes calls for gives the image of all effects. `all_rules`: enough of them for every
// rule to be met both ways.
inline void expect_random_scenes_equal(uint32_t scenes, bool all_rules) {
  std::map<std::string, uint32_t> skipped;
  double worst = 0;
  for (uint32_t seed = 0; seed < scenes; ++seed) {
    Laboratory lab(RandomScene(seed).make());
    for (const EffectDecision& d : decisions_of(lab.scene)) skipped[name(d.effect)] += d.needed ? 0 : 1;
    lab.importance_lights = 32;
    const Forced images = with_and_without(
        lab, seed % 2 ? "vpl" : "mfis",
        {.rsm = 32, .lights = 32, .visibility = seed % 4 < 2 ? Visibility::exact : Visibility::none});
    ASSERT_TRUE(check_health(images.all).finite()) << "scene " << seed;
    EXPECT_LT(images.difference, 1e-5) << "scene " << seed;
    worst = std::max(worst, images.difference);
  }
  std::printf("the largest difference of %u scenes: %.2g\n", scenes, worst);
  for (const auto& [effect, count] : skipped) {
    std::printf("%s skipped in %u\n", effect.c_str(), count);
    if (!all_rules || effect.starts_with("moving_")) continue;
    EXPECT_GT(count, 0u) << effect << " is never skipped: the generator does not try its rule";
    EXPECT_LT(count, scenes) << effect << " is always skipped";
  }
}

}  // namespace vsglbench
