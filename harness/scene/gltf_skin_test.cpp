// Skinned meshes at rest against the definition: p' = Σ w · W(joint) · B · p (glTF 2.0, 3.7.3.3).
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "scene/gltf_fixture.h"

namespace vsglbench {
namespace {

class GltfSkin : public GltfFixture {
 protected:
  void SetUp() override {
    GltfFixture::SetUp();
    add_square();
  }
  static std::vector<float> all_on_first() {
    std::vector<float> w;
    for (int i = 0; i < 4; ++i) w.insert(w.end(), {1, 0, 0, 0});
    return w;
  }
};

TEST_F(GltfSkin, TheMeshesOwnNodeDoesNotMoveIt) {
  json_["nodes"] = Json::parse(R"([{"mesh": 0, "translation": [100, 0, 0]}, {"translation": [0, 7, 0]}])");
  json_["scenes"][0]["nodes"] = {0, 1};
  add_skin({1}, std::vector<uint8_t>(16, 0), all_on_first());
  const Scene scene = load();
  EXPECT_LT(glm::length(world(scene, 0) - glm::dvec3(0, 7, 0)), 1e-6);
  EXPECT_LT(glm::length(world(scene, 2) - glm::dvec3(1, 8, 0)), 1e-6);
}

TEST_F(GltfSkin, StandsWhereAChainOfJointsPutsIt) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> u(-1, 1);
  // A chain of three joints, turned, moved and scaled at random, and any inverse bind matrices.
  json_["nodes"] =
      Json::parse(R"([{"mesh": 0, "rotation": [0, 0, 1, 0]}, {"children": [2]}, {"children": [3]}, {}])");
  json_["scenes"][0]["nodes"] = {0, 1};
  std::vector<glm::dmat4> worlds(3, glm::dmat4(1)), inverse(3);
  std::vector<float> matrices, weights;
  std::vector<uint8_t> joints;
  for (size_t j = 0; j < 3; ++j) {
    const glm::dvec3 t(u(random), u(random), u(random)), s(1 + 0.5 * u(random), 1 + 0.5 * u(random), 1);
    const glm::dquat q = glm::normalize(glm::dquat(1, u(random), u(random), u(random)));
    json_["nodes"][j + 1]["translation"] = {t.x, t.y, t.z};
    json_["nodes"][j + 1]["rotation"] = {q.x, q.y, q.z, q.w};
    json_["nodes"][j + 1]["scale"] = {s.x, s.y, s.z};
    worlds[j] = (j > 0 ? worlds[j - 1] : glm::dmat4(1)) * glm::translate(glm::dmat4(1), t) *
                glm::mat4_cast(q) * glm::scale(glm::dmat4(1), s);
    for (int k = 0; k < 16; ++k) {
      const float v = k == 15 ? 1 : k % 4 == 3 ? 0 : u(random);
      matrices.push_back(v);
      inverse[j][k / 4][k % 4] = v;
    }
  }
  for (int v = 0; v < 4; ++v) {
    float w[3] = {1 + u(random), 1 + u(random), 1 + u(random)};
    for (const float each : w) weights.push_back(each / (w[0] + w[1] + w[2]));
    weights.push_back(0);
    joints.insert(joints.end(), {2, 0, 1, 200});  // a joint without weight may be any
  }
  add_skin({1, 2, 3}, joints, weights, matrices);
  const Scene scene = load(2);
  const glm::dvec4 corners[] = {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1}};
  for (size_t v = 0; v < 4; ++v) {
    glm::dvec4 expected(0);
    for (size_t k = 0; k < 3; ++k)
      expected += double(weights[4 * v + k]) *
                  (worlds[joints[4 * v + k]] * (inverse[joints[4 * v + k]] * corners[v]));
    EXPECT_LT(glm::length(world(scene, v) - 2.0 * glm::dvec3(expected)), 1e-5) << v;
  }
}

TEST_F(GltfSkin, NormalsTurnWithTheJoints) {
  json_["nodes"] =
      Json::parse(R"([{"mesh": 0}, {"rotation": [0, 0.7071067811865476, 0, 0.7071067811865476]}])");
  json_["scenes"][0]["nodes"] = {0, 1};
  add_skin({1}, std::vector<uint8_t>(16, 0), all_on_first());
  for (const glm::vec3& n : load().normals) EXPECT_LT(glm::length(n - glm::vec3(1, 0, 0)), 1e-6f);
  primitive()["attributes"].erase("NORMAL");
  for (const glm::vec3& n : load().normals) EXPECT_LT(glm::length(n - glm::vec3(1, 0, 0)), 1e-6f);
}

TEST_F(GltfSkin, WhatIsMalformedIsSaid) {
  json_["nodes"].push_back(Json::object());
  add_skin({1}, std::vector<uint8_t>(16, 3), all_on_first());
  EXPECT_TRUE(contains(problem(), "vertex 0 is moved by joint 3, past the 1 of its skin"));
  add_skin({1}, std::vector<uint8_t>(16, 0), std::vector<float>(16, 0));
  EXPECT_TRUE(contains(problem(), "vertex 0 is moved by no joint"));
  add_skin({9}, std::vector<uint8_t>(16, 0), all_on_first());
  EXPECT_TRUE(contains(problem(), "joint: index 9 is past"));
  add_skin({1}, std::vector<uint8_t>(16, 0), all_on_first(), std::vector<float>(16, 1));
  json_["skins"][0]["joints"] = {1, 1};
  EXPECT_TRUE(contains(problem(), "1 matrices for 2 joints"));
  json_["nodes"][1]["children"] = {1};
  EXPECT_NE(problem(), "");
  primitive()["attributes"].erase("JOINTS_0");
  json_["nodes"][1].erase("children");
  json_["skins"][0].erase("inverseBindMatrices");
  EXPECT_TRUE(warned(load(), {"mesh 0 primitive 0", "no joints"}));
}

}  // namespace
}  // namespace vsglbench
