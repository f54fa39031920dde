#include "scene/surface.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vsglbench {
namespace {

// 2x2 texels: left column 0 and 64, right column 128 and 255, in red; alpha 255 but for the last one.
Texture texture(bool srgb) {
  return {"t", 2, 2, srgb, {0, 10, 20, 255, 128, 10, 20, 255, 64, 10, 20, 255, 255, 10, 20, 0}};
}

double decode(double byte) {
  const double s = byte / 255;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

// One triangle in the plane z = 0 with normal +z, uv equal to xy, tangent +x and bitangent +y.
Scene one_triangle() {
  Scene scene;
  scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.normals.assign(3, {0, 0, 1});
  scene.tangents.assign(3, {1, 0, 0, 1});
  scene.uvs = {{0, 0}, {1, 0}, {0, 1}};
  scene.triangles = {{0, 1, 2}};
  scene.triangle_material = {0};
  scene.materials.resize(1);
  return scene;
}

void set_normal_map(Scene* scene, glm::vec3 n) {
  const auto byte = [](float v) { return static_cast<uint8_t>((0.5f + 0.5f * v) * 255 + 0.5f); };
  scene->textures = {{"n", 1, 1, false, {byte(n.x), byte(n.y), byte(n.z), 255}}};
  scene->materials[0].normal_texture = 0;
}

const glm::vec3 kUp(0, 0, 1);
const glm::vec2 kMiddle(0.25f, 0.25f);

TEST(SampleTexture, TexelCentresAreExact) {
  EXPECT_FLOAT_EQ(sample_texture(texture(false), {0.25f, 0.25f}).x, 0);
  EXPECT_FLOAT_EQ(sample_texture(texture(false), {0.75f, 0.25f}).x, 128 / 255.0f);
  EXPECT_FLOAT_EQ(sample_texture(texture(false), {0.25f, 0.75f}).x, 64 / 255.0f);
  EXPECT_FLOAT_EQ(sample_texture(texture(false), {0.75f, 0.75f}).w, 0);
}

TEST(SampleTexture, IsBilinearAndRepeats) {
  const float mean = (0 + 128 + 64 + 255) / (4 * 255.0f);
  EXPECT_NEAR(sample_texture(texture(false), {0.5f, 0.5f}).x, mean, 1e-6);
  EXPECT_NEAR(sample_texture(texture(false), {0.0f, 0.0f}).x, mean, 1e-6);  // across the seam
  EXPECT_NEAR(sample_texture(texture(false), {-3.75f, 7.25f}).x, 0, 1e-6);
  EXPECT_NEAR(sample_texture(texture(false), {0.375f, 0.25f}).x, 0.25f * 128 / 255, 1e-6);
}

TEST(SampleTexture, DecodesSrgbBeforeFiltering) {
  const glm::vec4 v = sample_texture(texture(true), {0.5f, 0.25f});
  EXPECT_NEAR(v.x, 0.5 * (decode(0) + decode(128)), 1e-6);
  EXPECT_NEAR(v.y, decode(10), 1e-6);
  EXPECT_FLOAT_EQ(v.w, 1);  // alpha is not encoded
}

TEST(Surface, HoleIsWhereAlphaIsBelowTheCutoff) {
  Scene scene = one_triangle();
  scene.textures = {{"t", 2, 1, true, {255, 255, 255, 255, 255, 255, 255, 0}}};
  scene.materials[0].base_color_texture = 0;
  EXPECT_FALSE(is_hole(scene, 0, {0.75f, 0.1f}));  // no mask
  scene.materials[0].alpha_cutoff = 0.5f;
  EXPECT_TRUE(is_hole(scene, 0, {0.75f, 0.1f}));
  EXPECT_FALSE(is_hole(scene, 0, {0.25f, 0.1f}));
  scene.materials[0].base_color.w = 0.4f;  // the factor counts too
  EXPECT_TRUE(is_hole(scene, 0, {0.25f, 0.1f}));
}

TEST(Surface, MaterialFollowsItsFormulas) {
  Scene scene = one_triangle();
  Material& m = scene.materials[0];
  m.base_color = {0.8f, 0.4f, 0.2f, 1};
  m.metallic = 0.5f;
  m.roughness = 0.6f;
  m.specular = 0.5f;
  scene.textures = {{"mr", 1, 1, false, {0, 128, 64, 255}}};
  m.metallic_roughness_texture = 0;
  const Surface s = surface_at(scene, 0, kMiddle, kUp);
  const float metallic = 0.5f * 64 / 255, roughness = 0.6f * 128 / 255;
  EXPECT_NEAR(s.diffuse.x, 0.8f * (1 - metallic) * (1 - 0.02f), 1e-6);
  EXPECT_NEAR(s.f0.y, 0.5f * (0.04f * (1 - metallic) + 0.4f * metallic), 1e-6);
  EXPECT_NEAR(s.ndf, roughness * roughness, 1e-6);
  m.phong_exponent = 1023;
  EXPECT_EQ(surface_at(scene, 0, kMiddle, kUp).ndf, -1023);
  m.phong_exponent = 0;
  m.roughness = 0;
  EXPECT_FLOAT_EQ(surface_at(scene, 0, kMiddle, kUp).ndf, 1e-3f);
  m.specular = 0;
  EXPECT_EQ(surface_at(scene, 0, kMiddle, kUp).f0, glm::vec3(0));
}

TEST(Surface, NormalsFaceTheViewerOnBothSides) {
  const Scene scene = one_triangle();
  for (const float side : {1.0f, -1.0f}) {
    const Surface s = surface_at(scene, 0, kMiddle, glm::normalize(glm::vec3(0.3f, 0, side)));
    EXPECT_NEAR(s.geometric_normal.z, side, 1e-6);
    EXPECT_NEAR(s.normal.z, side, 1e-6);
  }
}

TEST(Surface, NormalMapTiltsAlongTangentAndBitangent) {
  Scene scene = one_triangle();
  set_normal_map(&scene, glm::normalize(glm::vec3(0.5f, 0.25f, 1)));
  const Surface s = surface_at(scene, 0, kMiddle, kUp);
  EXPECT_NEAR(s.normal.x / s.normal.z, 0.5f, 0.02f);
  EXPECT_NEAR(s.normal.y / s.normal.z, 0.25f, 0.02f);
  scene.materials[0].normal_scale = 2;
  EXPECT_NEAR(surface_at(scene, 0, kMiddle, kUp).normal.x / surface_at(scene, 0, kMiddle, kUp).normal.z, 1,
              0.04f);
  scene.tangents.assign(3, {1, 0, 0, -1});  // a mirrored texture turns the bitangent over
  EXPECT_LT(surface_at(scene, 0, kMiddle, kUp).normal.y, 0);
  // From behind the whole normal is turned over.
  scene.tangents.assign(3, {1, 0, 0, 1});
  const Surface front = surface_at(scene, 0, kMiddle, kUp), back = surface_at(scene, 0, kMiddle, -kUp);
  EXPECT_NEAR(glm::length(front.normal + back.normal), 0, 1e-6);
}

TEST(Surface, ShadingNormalStaysVisible) {
  Scene scene = one_triangle();
  set_normal_map(&scene, glm::normalize(glm::vec3(1, 0, 0.2f)));
  const glm::vec3 viewer = glm::normalize(glm::vec3(-1, 0, 0.1f));
  const Surface s = surface_at(scene, 0, kMiddle, viewer);
  EXPECT_GT(glm::dot(s.normal, viewer), 0);
  EXPECT_NEAR(glm::length(s.normal), 1, 1e-6);
}

TEST(Surface, TriangleWithoutAreaTakesTheVertexNormal) {
  Scene scene = one_triangle();
  scene.positions.assign(3, glm::vec3(1, 2, 3));
  const Surface s = surface_at(scene, 0, kMiddle, kUp);
  EXPECT_EQ(s.geometric_normal, kUp);
  EXPECT_EQ(s.normal, kUp);
}

}  // namespace
}  // namespace vsglbench
