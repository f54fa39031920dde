#include "scene/builders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/check.h"
#include "scene/mesh.h"

namespace vsglbench {
namespace {

Scene built(const std::string& builder, const Json& parameters = Json::object()) {
  Scene scene;
  scene.name = builder;
  build_scene(builder, parameters, &scene);
  scene.light.up = {0, 0, 1};
  return scene;
}

TEST(Builders, TriangleCounts) {
  EXPECT_EQ(built("cornell").triangles.size(), 5 * 2 + 2 * 5 * 2u);
  EXPECT_EQ(built("ring514").triangles.size(), 514u);
  const double count = static_cast<double>(built("colonnade").triangles.size());
  EXPECT_NEAR(count / 262000, 1, 0.005) << count;
}

TEST(Builders, ScenesAreSoundAndRepeatable) {
  for (const BuilderEntry& entry : scene_builders()) {
    const Scene scene = built(entry.name);
    EXPECT_NO_THROW(check_scene(scene)) << entry.name;
    EXPECT_TRUE(scene.warnings.empty()) << entry.name << ": " << scene.warnings.front();
    EXPECT_EQ(scene_hash(scene), scene_hash(built(entry.name))) << entry.name;
  }
}

// Faces wind counter-clockwise seen from where their normals point.
TEST(Builders, WindingAgreesWithNormals) {
  for (const BuilderEntry& entry : scene_builders()) {
    const Scene scene = built(entry.name);
    size_t wrong = 0;
    for (const glm::uvec3& t : scene.triangles) {
      const glm::vec3 face = glm::cross(scene.positions[t.y] - scene.positions[t.x],
                                        scene.positions[t.z] - scene.positions[t.x]);
      if (glm::dot(face, scene.normals[t.x] + scene.normals[t.y] + scene.normals[t.z]) <= 0) ++wrong;
    }
    EXPECT_EQ(wrong, 0u) << entry.name;
  }
}

TEST(Builders, CornellIsPurelyDiffuse) {
  for (const Material& m : built("cornell").materials) EXPECT_EQ(m.specular, 0);
}

TEST(Builders, RingIsARoundSmoothMirror) {
  const Scene scene = built("ring514");
  EXPECT_EQ(scene.batches[1].triangle_count, 512u);
  EXPECT_EQ(scene.materials[scene.batches[1].material].phong_exponent, 65535);
  for (uint32_t i = 2; i < scene.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const uint32_t v = scene.triangles[i][k];
      const glm::dvec3 p = glm::dvec3(scene.positions[v]) + scene.origin;
      EXPECT_NEAR(std::hypot(p.x, p.z), 1, 1e-6);
      EXPECT_TRUE(std::abs(p.y) < 1e-6 || std::abs(p.y - 0.5) < 1e-6);  // stands on the floor
      EXPECT_NEAR(glm::dot(glm::dvec3(scene.normals[v]), glm::dvec3(p.x, 0, p.z)), 1, 1e-6);
    }
  }
}

TEST(Builders, ColonnadeStandsOnTheGround) {
  const Scene scene = built("colonnade");
  EXPECT_NEAR(scene.bounds_min.y + scene.origin.y, 0, 1e-6);
  EXPECT_NEAR(scene.bounds_max.x - scene.bounds_min.x, 26, 1e-5);
  EXPECT_NEAR(scene.bounds_max.z - scene.bounds_min.z, 16, 1e-5);
  size_t textured = 0, mapped = 0;
  for (const Material& m : scene.materials) {
    textured += m.base_color_texture >= 0;
    mapped += m.normal_texture >= 0;
  }
  EXPECT_GE(textured, 3u);
  EXPECT_GE(mapped, 3u);
  EXPECT_EQ(scene.materials[0].name, "floor");
  EXPECT_EQ(scene.materials[0].phong_exponent, 1023);
}

// The step across the border is no larger than the largest inside, where joints and tiles end.
TEST(Builders, TexturesRepeatWithoutASeam) {
  for (const Texture& t : built("colonnade").textures) {
    std::vector<double> step(t.width, 0);  // between columns x and x + 1, the last one across the border
    for (uint32_t y = 0; y < t.height; ++y) {
      const uint8_t* row = &t.rgba[size_t(4) * y * t.width];
      for (uint32_t x = 0; x < t.width; ++x) step[x] += std::abs(row[4 * x] - row[4 * ((x + 1) % t.width)]);
    }
    const double border = step.back();
    step.pop_back();
    EXPECT_LE(border, 1.5 * *std::max_element(step.begin(), step.end())) << t.name;
  }
}

TEST(Builders, NamesAndParametersAreChecked) {
  EXPECT_THROW(built("cornel"), Error);
  EXPECT_THROW(built("ring514", {{"radios", 2}}), Error);
  EXPECT_THROW(built("ring514", {{"radius", -2}}), Error);
  EXPECT_THROW(built("ring514", {{"radius", "big"}}), Error);
  EXPECT_EQ(built("ring514", {{"segments", 16}}).triangles.size(), 2 + 32u);
  try {
    built("ring514", {{"radios", 2}});
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("did you mean 'radius'"), std::string::npos) << e.what();
  }
}

TEST(AnyOrthogonal, IsUnitAndOrthogonal) {
  for (const glm::vec3 n :
       {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(0.6f, 0, -0.8f), glm::vec3(0, 1, 0)}) {
    EXPECT_NEAR(glm::length(any_orthogonal(n)), 1, 1e-6);
    EXPECT_NEAR(glm::dot(any_orthogonal(n), n), 0, 1e-6);
  }
}

}  // namespace
}  // namespace vsglbench
