#include <unistd.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "scene/animation.h"
#include "scene/gltf_fixture.h"

namespace vsglbench {
namespace {

using glm::dmat4;
using glm::dvec3;

constexpr double kRoot = std::numbers::sqrt2 / 2;

// Frame t is at t / 4 seconds.
class GltfAnimation : public GltfFixture {
 protected:
  void SetUp() override {
    GltfFixture::SetUp();
    add_square();
    json_["nodes"] = Json::parse(R"([{"mesh": 0, "name": "door"}, {"mesh": 0, "translation": [0, 0, -5]}])");
    json_["scenes"][0]["nodes"] = {0, 1};
    json_["animations"] = {{{"name", "swing"}, {"channels", Json::array()}, {"samplers", Json::array()}}};
  }
  // Keys `path` of a node; values as they stand in the file.
  void animate(int node, const char* path, const std::vector<float>& times, const std::vector<float>& values,
               const char* interpolation = "LINEAR", size_t animation = 0) {
    Json& a = json_["animations"][animation];
    const bool rotation = std::string(path) == "rotation";
    const int input = add_floats(times, "SCALAR", 1);
    const int output = add_floats(values, rotation ? "VEC4" : "VEC3", rotation ? 4 : 3);
    a["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
    a["channels"].push_back(
        {{"sampler", a["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }
  Scene load_frames(uint32_t frames, double unit = 1) {
    Scene scene;
    scene.animation.frames = frames;
    scene.animation.rate = 4;
    load_gltf(write_gltf(), unit, &scene);
    scene.light.up = {0, 0, 1};
    check_scene(scene);
    return scene;
  }
  std::string problem_in_frames(uint32_t frames = 4) {
    try {
      load_frames(frames);
      return "";
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::scene);
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
      return e.what();
    }
  }
  // The square's vertices where `m` puts them, against those of an object.
  void expect_pose(const Scene& scene, const dmat4& m, size_t object = 0, double unit = 1) {
    const MovingObject& o = scene.animation.objects.at(object);
    const dvec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (uint32_t i = 0; i < 4; ++i) {
      const dvec3 want = unit * dvec3(m * glm::dvec4(corners[i], 1));
      const dvec3 got = dvec3(scene.positions[o.first_vertex + i]) + scene.origin;
      EXPECT_LT(glm::length(want - got), 2e-6) << i << ": " << got.x << " " << got.y << " " << got.z;
    }
  }
};

dmat4 moved(const dvec3& by) { return glm::translate(dmat4(1), by); }
dmat4 turned(double degrees, const dvec3& axis) { return glm::rotate(dmat4(1), glm::radians(degrees), axis); }

TEST_F(GltfAnimation, LinearTranslation) {
  animate(0, "translation", {0.25f, 0.75f}, {0, 0, 0, 2, 4, 0});
  Scene scene = load_frames(5);
  ASSERT_EQ(scene.animation.objects.size(), 1u);
  ASSERT_EQ(scene.triangles.size(), 4u);
  const MovingObject& door = scene.animation.objects[0];
  EXPECT_EQ(door.name, "node 0 'door'");
  // What stands still comes first, and is the origin's.
  EXPECT_EQ(door.first_triangle, 2u);
  EXPECT_EQ(door.first_vertex, 4u);
  EXPECT_EQ(scene.origin, dvec3(0.5, 0.5, -5));
  const double steps[] = {0, 0, 0.5, 1, 1};
  for (uint32_t frame = 0; frame < 5; ++frame) {
    set_frame(&scene, frame);
    expect_pose(scene, moved(steps[frame] * dvec3(2, 4, 0)));
  }
}

TEST_F(GltfAnimation, StepTranslation) {
  animate(0, "translation", {0, 0.5f}, {0, 0, 0, 2, 4, 0}, "STEP");
  Scene scene = load_frames(4);
  set_frame(&scene, 1);
  expect_pose(scene, moved({0, 0, 0}));
  set_frame(&scene, 2);
  expect_pose(scene, moved({2, 4, 0}));
}

// 0 to 90 degrees about Y within 0.75 s: 30 degrees a frame.
TEST_F(GltfAnimation, LinearRotationIsSpherical) {
  const float r = static_cast<float>(kRoot);
  animate(0, "rotation", {0, 0.75f}, {0, 0, 0, 1, 0, r, 0, r});
  Scene scene = load_frames(4);
  for (uint32_t frame = 0; frame < 4; ++frame) {
    set_frame(&scene, frame);
    expect_pose(scene, turned(30.0 * frame, {0, 1, 0}));
    // The normal turns with it: (0, 0, 1) to (1, 0, 0).
    const glm::vec3 n = scene.normals[scene.animation.objects[0].first_vertex];
    EXPECT_NEAR(n.x, std::sin(glm::radians(30.0 * frame)), 1e-6);
    EXPECT_NEAR(n.z, std::cos(glm::radians(30.0 * frame)), 1e-6);
  }
}

// In-tangent, value, out-tangent of each key.
TEST_F(GltfAnimation, CubicScale) {
  animate(0, "scale", {0, 1}, {9, 9, 9, 1, 1, 1, 1, 0, 0, 0, -2, 0, 3, 1, 2, 9, 9, 9}, "CUBICSPLINE");
  Scene scene = load_frames(5);
  for (uint32_t frame = 0; frame < 5; ++frame) {
    set_frame(&scene, frame);
    const double t = frame / 4.0, t2 = t * t, t3 = t2 * t;
    const dvec3 scale = (2 * t3 - 3 * t2 + 1) * dvec3(1) + (t3 - 2 * t2 + t) * dvec3(1, 0, 0) +
                        (-2 * t3 + 3 * t2) * dvec3(3, 1, 2) + (t3 - t2) * dvec3(0, -2, 0);
    expect_pose(scene, glm::scale(dmat4(1), scale));
  }
}

// Root stands still, its child moves, the grandchild stands still in it, the last one turns; the file is in
// half metres.
TEST_F(GltfAnimation, NodesCompose) {
  json_["nodes"] = Json::parse(R"([
    {"translation": [10, 0, 0], "rotation": [0, 0, 0.70710678118654752, 0.70710678118654752], "children": [2]},
    {"mesh": 0},
    {"name": "arm", "children": [3]},
    {"matrix": [0,1,0,0, -1,0,0,0, 0,0,1,0, 0,0,7,1], "mesh": 0, "children": [4]},
    {"translation": [1, 2, 3], "scale": [2, 1, 1], "mesh": 0}])");
  const float r = static_cast<float>(kRoot);
  animate(2, "translation", {0, 1}, {0, 0, 0, 0, 0, 8});
  animate(4, "rotation", {0, 1}, {0, 0, 0, 1, r, 0, 0, r});
  Scene scene = load_frames(5, 0.5);
  ASSERT_EQ(scene.animation.objects.size(), 2u);
  EXPECT_EQ(scene.animation.nodes.size(), 3u);
  EXPECT_EQ(scene.animation.moves.objects, (std::vector<uint32_t>{0, 1}));
  for (uint32_t frame = 0; frame < 5; ++frame) {
    set_frame(&scene, frame);
    const dmat4 root = moved({10, 0, 0}) * turned(90, {0, 0, 1});
    const dmat4 arm = root * moved({0, 0, 2.0 * frame});
    const dmat4 hand = arm * moved({0, 0, 7}) * turned(90, {0, 0, 1});
    expect_pose(scene, hand, 0, 0.5);
    expect_pose(scene,
                hand * moved({1, 2, 3}) * turned(22.5 * frame, {1, 0, 0}) * glm::scale(dmat4(1), {2, 1, 1}),
                1, 0.5);
  }
}

// Each pose is the scene that a file without animation gives, whose node stands where the animated one is.
TEST_F(GltfAnimation, APoseIsTheStillSceneOfItsTransforms) {
  animate(0, "translation", {0, 1}, {0, 0, 0, 4, 0, 0});
  animate(0, "scale", {0, 1}, {1, 1, 1, -1, 3, 1});
  Scene moving = load_frames(5);
  set_frame(&moving, 3);
  json_.erase("animations");
  json_["nodes"][0]["translation"] = {3, 0, 0};
  json_["nodes"][0]["scale"] = {-0.5, 2.5, 1};
  json_["scenes"][0]["nodes"] = {1, 0};  // what stands still first
  const Scene still = load();
  const dvec3 shift = still.origin - moving.origin;
  ASSERT_EQ(moving.positions.size(), still.positions.size());
  for (size_t i = 0; i < still.positions.size(); ++i) {
    EXPECT_LT(glm::length(dvec3(moving.positions[i]) - dvec3(still.positions[i]) - shift), 1e-6);
    EXPECT_LT(glm::length(moving.normals[i] - still.normals[i]), 1e-6);
    EXPECT_LT(glm::length(moving.tangents[i] - still.tangents[i]), 1e-6);  // w, too
  }
}

TEST_F(GltfAnimation, WithoutAnythingStillTheOriginIsTheFirstFramesCentre) {
  json_["scenes"][0]["nodes"] = {0};
  animate(0, "translation", {0, 1}, {100, 0, 0, 200, 0, 0});
  for (const uint32_t frames : {1u, 5u}) {
    const Scene scene = load_frames(frames);
    EXPECT_EQ(scene.origin, dvec3(100.5, 0.5, 0));
    EXPECT_FLOAT_EQ(scene.bounds_max.x, frames == 1 ? 0.5f : 100.5f);
  }
}

TEST_F(GltfAnimation, StillScenesDoNotPlay) {
  animate(0, "translation", {0, 1}, {3, 0, 0, 4, 0, 0});
  Scene scene = load();
  EXPECT_TRUE(scene.animation.objects.empty());
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_TRUE(contains(scene.warnings[0], "not played"));
  // The node stands where the file puts it at rest.
  EXPECT_EQ(dvec3(scene.positions[0]) + scene.origin, dvec3(0, 0, 0));
}

TEST_F(GltfAnimation, TheFirstAnimationOfAPropertyCounts) {
  json_["animations"].push_back({{"channels", Json::array()}, {"samplers", Json::array()}});
  animate(0, "translation", {0, 1}, {0, 0, 0, 4, 0, 0});
  animate(0, "translation", {0, 1}, {0, 0, 0, 9, 9, 9}, "LINEAR", 1);
  animate(0, "scale", {0}, {2, 1, 1}, "LINEAR", 1);
  Scene scene = load_frames(5);
  set_frame(&scene, 2);
  expect_pose(scene, moved({2, 0, 0}) * glm::scale(dmat4(1), {2, 1, 1}));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_TRUE(
      contains(scene.warnings[0], "animation 1 channel 0: an earlier animation keys the translation"));
}

TEST_F(GltfAnimation, MorphTargetsAreRefusedByName) {
  animate(0, "translation", {0, 1}, {0, 0, 0, 4, 0, 0});
  json_["animations"][0]["channels"][0]["target"]["path"] = "weights";
  const std::string problem = problem_in_frames();
  EXPECT_TRUE(contains(problem, "animation 0 'swing' channel 0: moves the morph targets of node 0 'door'"));
  EXPECT_EQ(problem_in_frames(0), "");  // a still scene draws the mesh at rest, with a warning
}

TEST_F(GltfAnimation, SkinsAreRefusedByNameWhereTheyMove) {
  json_["nodes"] = Json::parse(R"([{"name": "hip", "children": [2]}, {"mesh": 0, "skin": 0, "name": "body"},
                                   {"name": "knee"}, {"mesh": 0, "name": "ball"}])");
  json_["scenes"][0]["nodes"] = {0, 1, 3};
  std::vector<float> identity(16, 0);
  for (size_t i = 0; i < 16; i += 5) identity[i] = 1;
  const int matrices = add_floats(identity, "MAT4", 16);
  json_["skins"] = {{{"name", "leg"}, {"joints", {2}}, {"inverseBindMatrices", matrices}}};
  animate(3, "translation", {0, 1}, {0, 0, 0, 4, 0, 0});
  EXPECT_EQ(problem_in_frames(), "");  // only the ball moves
  animate(0, "translation", {0, 1}, {0, 0, 0, 4, 0, 0});
  EXPECT_TRUE(contains(problem_in_frames(), "animation 0 'swing' moves skin 0 'leg' of node 1 'body'"));
  EXPECT_EQ(problem_in_frames(0), "");
}

TEST_F(GltfAnimation, BadOnesAreErrors) {
  const auto problem = [this](const char* path, const std::vector<float>& times,
                              const std::vector<float>& values, const char* interpolation = "LINEAR") {
    const Json before = json_;
    animate(0, path, times, values, interpolation);
    std::string text = problem_in_frames();
    json_ = before;
    return text;
  };
  EXPECT_TRUE(contains(problem("translation", {0, 1}, {0, 0, 0}), "channel 0: 1 values at 2 times"));
  EXPECT_TRUE(
      contains(problem("translation", {0, 1}, {0, 0, 0, 0, 0, 0}, "CUBICSPLINE"), "2 values at 2 times"));
  EXPECT_TRUE(contains(problem("translation", {1, 0}, {0, 0, 0, 0, 0, 0}), "does not come after"));
  EXPECT_TRUE(contains(problem("translation", {0, NAN}, {0, 0, 0, 0, 0, 0}), "not finite"));
  EXPECT_TRUE(contains(problem("translation", {}, {}), "no key"));
  EXPECT_TRUE(contains(problem("rotation", {0}, {0, 0, 0, 0}), "has no length"));
  EXPECT_TRUE(contains(problem("scale", {0}, {1, 1, 1}, "WAVY"), "unknown interpolation 'WAVY'"));
  EXPECT_TRUE(contains(problem("translation", {0, 0.5f}, {0, 0, 0, 1e30f, 0, 0}),
                       "at frame 1, 'node 0 'door'' lies"));
}

TEST_F(GltfAnimation, BadTargetsAreErrors) {
  animate(0, "translation", {0, 1}, {0, 0, 0, 4, 0, 0});
  const auto after = [this](const std::string& pointer, const Json& value) {
    const Json before = json_;
    json_[Json::json_pointer(pointer)] = value;
    std::string text = problem_in_frames();
    json_ = before;
    return text;
  };
  EXPECT_TRUE(contains(after("/animations/0/channels/0/sampler", 3), "sampler: index 3 is past the 1"));
  EXPECT_TRUE(
      contains(after("/animations/0/channels/0/target/node", 9), "target node: index 9 is past the 2"));
  EXPECT_TRUE(contains(after("/animations/0/samplers/0/input", 99), "input"));
  EXPECT_TRUE(
      contains(after("/nodes/0/matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}), "has a matrix"));
  EXPECT_EQ(after("/animations/0/channels/0/target/path", "pointer"), "");  // ignored, with a warning
}

// Each byte replaced in turn, by several values: the loader may accept or refuse, but what it accepts is
// sound in every frame.
TEST_F(GltfAnimation, AnyByteChangedIsSurvived) {
  animate(0, "translation", {0, 0.25f, 0.5f}, {0, 0, 0, 4, 0, 0, 4, 1, 0});
  animate(0, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0},
          "CUBICSPLINE");
  const std::string bytes = glb_bytes();
  int loaded = 0, refused = 0;
  for (size_t i = 0; i < bytes.size(); ++i) {
    for (const int value : {0x00, 0x7f, 0x39}) {
      std::string changed = bytes;
      changed[i] = static_cast<char>(value);
      write("changed.glb", changed);
      Scene scene;
      scene.animation.frames = 3;
      scene.animation.rate = 4;
      try {
        load_gltf(folder_ / "changed.glb", 1, &scene);
        ++loaded;
      } catch (const Error&) {
        ++refused;
        continue;
      }
      scene.light.up = {0, 0, 1};
      ASSERT_NO_THROW(check_scene(scene)) << "byte " << i << " is " << value;
      for (uint32_t frame = 0; frame < 3; ++frame) set_frame(&scene, frame);
    }
  }
  EXPECT_GT(loaded, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace vsglbench
