#include "scene/animation.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/gltf_fixture.h"
#include "scene/scene_file.h"
#include "scene/view.h"

namespace vsglbench {
namespace {

using glm::dmat3;
using glm::dvec3;

// A ring that rests, moves and rests over 6 frames of 1/4 s each, in a room whose light and camera follow
// later.
constexpr const char* kText = R"({
  "name": "test", "description": "a ring in a room",
  "geometry": {"builder": "cornell"},
  "animation": {"frames": 8, "rate": 4},
  "objects": [{
    "name": "ring", "torus": {"major": 0.3, "minor": 0.1, "segments": 12, "sides": 5},
    "keys": [{"time": 0.25, "translation": [0, 1, 0], "rotation": [0, 0, 0, 1], "scale": 1},
             {"time": 0.75, "translation": [0.4, 1.2, -0.2], "rotation": [0.6, 0, 0, 0.8], "scale": [1, 2, 0.5]}]}],
  "views": {"A": {
    "camera": {"eye": [0, 1, 3], "direction": [0, 0, -1], "vfov": 50,
               "keys": [{"time": 1, "eye": [0, 1, 3]}, {"time": 1.25, "eye": [0.1, 1, 3]}]},
    "light": {"spot": {"position": [0.3, 1.9, 0.4], "target": [0, 0, 0], "fov": 70, "intensity": 10,
              "keys": [{"time": 1.25, "intensity": 10}, {"time": 1.5, "intensity": [5, 0, 0]}]}}}},
  "default_view": "A"
})";

class Animated : public GltfFixture {
 protected:
  Scene load_text(const std::string& text, uint32_t frames = 0) {
    write("scene.json", text);
    return load_scene((folder_ / "scene.json").string(), {"", "", frames});
  }
  std::string with(const std::string& from, const std::string& to) {
    std::string text = kText;
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }
  std::string with_sun() {
    const std::string text = kText;
    const size_t at = text.find("{\"spot\""), end = text.find("]}}}},");
    return text.substr(0, at) + R"({"sun": {"direction": [0.1, -1, 0], "irradiance": 8}})" +
           text.substr(end + 3);
  }
};

// The columns of a rotation by a unit quaternion, as any textbook has them.
dmat3 matrix_of(double x, double y, double z, double w) {
  return dmat3(dvec3(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
               dvec3(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)),
               dvec3(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)));
}

// At half of the way: half of the translation, of the angle 2 asin(0.6) about X, and of the scale.
TEST_F(Animated, APoseIsTranslationTimesRotationTimesScale) {
  Scene scene = load_text(kText);
  set_frame(&scene, 2);
  const double half = std::asin(0.6) / 2;
  const dmat3 rotation = matrix_of(std::sin(half), 0, 0, std::cos(half));
  const dvec3 scale(1, 1.5, 0.75), translation(0.2, 1.1, -0.1);
  const MovingObject& ring = scene.animation.objects.at(0);
  for (uint32_t i = 0; i < ring.vertex_count; ++i) {
    const dvec3 p = translation + rotation * (scale * ring.positions[i]);
    EXPECT_LT(glm::length(dvec3(scene.positions[ring.first_vertex + i]) + scene.origin - p), 1e-6);
    const dvec3 n = glm::normalize(rotation * (dvec3(ring.normals[i]) / scale));  // the inverse transpose
    EXPECT_LT(glm::length(dvec3(scene.normals[ring.first_vertex + i]) - n), 1e-6);
    const glm::vec3 tangent(scene.tangents[ring.first_vertex + i]);
    EXPECT_NEAR(glm::length(tangent), 1, 1e-6);
    EXPECT_NEAR(glm::dot(tangent, scene.normals[ring.first_vertex + i]), 0, 1e-6);
  }
}

TEST_F(Animated, ToldIsWhatMovesAndNothingElse) {
  Scene scene = load_text(kText);
  EXPECT_EQ(frame_count(scene), 8u);
  EXPECT_DOUBLE_EQ(frame_time(scene, 3), 0.75);
  const auto expect = [&scene](uint32_t frame, size_t objects, bool camera, bool light) {
    const std::string before = scene.hash;
    const Moved moved = set_frame(&scene, frame);
    EXPECT_EQ(moved.objects.size(), objects) << frame;
    EXPECT_EQ(moved.camera, camera) << frame;
    EXPECT_EQ(moved.light, light) << frame;
    EXPECT_EQ(scene.hash != before, moved.any()) << frame;
    EXPECT_EQ(scene.hash, scene_hash(scene));
  };
  expect(0, 0, false, false);
  expect(1, 0, false, false);
  expect(2, 1, false, false);
  expect(3, 1, false, false);
  expect(3, 0, false, false);
  expect(4, 0, false, false);
  expect(5, 0, true, false);
  expect(6, 0, false, true);
  expect(7, 0, false, false);
  expect(0, 1, true, true);
  EXPECT_EQ(scene.animation.moves.objects, std::vector<uint32_t>{0});
  EXPECT_TRUE(scene.animation.moves.camera && scene.animation.moves.light);
  EXPECT_THROW(set_frame(&scene, 8), std::logic_error);
}

TEST_F(Animated, OnlyMovingVerticesAreWritten) {
  Scene scene = load_text(kText);
  const Scene before = scene;
  const size_t still = still_vertices(scene);
  EXPECT_EQ(still_triangles(scene), 30u);
  EXPECT_EQ(scene.triangles.size(), 30u + 2 * 12 * 5);
  set_frame(&scene, 5);
  const auto differ = [&](const auto& a, const auto& b) {
    size_t n = 0;
    for (size_t i = 0; i < a.size(); ++i) {
      if (a[i] == b[i]) continue;
      ++n;
      EXPECT_GE(i, still);
    }
    return n;
  };
  EXPECT_GT(differ(scene.positions, before.positions), 60u);
  EXPECT_GT(differ(scene.normals, before.normals), 60u);
  EXPECT_TRUE(scene.triangles == before.triangles && scene.uvs == before.uvs);
  EXPECT_EQ(scene.batches.size(), before.batches.size());
}

// The still part of a scene with objects is the still scene, to the bit.
TEST_F(Animated, ObjectsLeaveTheRestAsItIs) {
  const Scene moving = load_text(kText);
  Json json = Json::parse(kText);
  json.erase("objects");
  const Scene rest = load_text(json.dump(1));
  EXPECT_EQ(moving.origin, rest.origin);
  EXPECT_TRUE(std::equal(rest.positions.begin(), rest.positions.end(), moving.positions.begin()));
  EXPECT_TRUE(std::equal(rest.triangles.begin(), rest.triangles.end(), moving.triangles.begin()));
  EXPECT_EQ(moving.materials.back().name, "object ring");
  EXPECT_EQ(moving.batches.back().first_triangle, 30u);
}

TEST_F(Animated, APoseIsTheSameHoweverItIsReached) {
  Scene scene = load_text(kText);
  std::vector<Scene> poses;
  for (uint32_t frame = 0; frame < 8; ++frame) {
    set_frame(&scene, frame);
    poses.push_back(scene);
  }
  for (const uint32_t frame : {5u, 2u, 7u, 0u, 6u, 3u, 1u, 4u}) {
    set_frame(&scene, frame);
    EXPECT_EQ(scene.hash, poses[frame].hash);
    EXPECT_EQ(scene.positions, poses[frame].positions);
    EXPECT_EQ(scene.tangents, poses[frame].tangents);
    EXPECT_TRUE(same_bits(scene.light, poses[frame].light) && same_bits(scene.camera, poses[frame].camera));
  }
}

// Not with more frames, either, which reach further: neither through the origin, nor through how far a sun is
// moved back.
TEST_F(Animated, AHashDoesNotDependOnOtherFrames) {
  const std::string further =
      with("0.75, \"translation\": [0.4, 1.2, -0.2]", "0.75, \"translation\": [0.4, 9, -0.2]");
  Json sun = Json::parse(with_sun());
  sun["objects"][0]["keys"][1]["translation"] = {0.4, 9, -0.2};
  sun["views"]["A"]["light"]["sun"]["direction"] = {0, -1, 0};  // under which the ring stays in the rectangle
  sun["views"]["A"]["light"]["sun"]["keys"] = {{{"time", 0}, {"irradiance", 8}},
                                               {{"time", 3}, {"irradiance", 9}}};
  for (const std::string& text : {further, sun.dump(1)}) {
    std::vector<std::string> all;
    Scene longest = load_text(text, 20);
    for (uint32_t frame = 0; frame < 20; ++frame) {
      set_frame(&longest, frame);
      all.push_back(longest.hash);
    }
    for (const uint32_t frames : {1u, 2u, 3u, 7u}) {
      Scene scene = load_text(text, frames);
      EXPECT_EQ(frame_count(scene), frames);
      for (uint32_t frame = 0; frame < frames; ++frame) {
        set_frame(&scene, frame);
        EXPECT_EQ(scene.hash, all[frame]) << frame << " of " << frames;
      }
    }
  }
}

TEST_F(Animated, BoundsAreThoseOfAllFrames) {
  Scene scene = load_text(with("0.4, 1.2, -0.2", "0.4, 3, -0.2"));
  const float diagonal = scene.diagonal();
  const glm::vec3 low = scene.bounds_min, high = scene.bounds_max;
  bool touched = false;
  for (uint32_t frame = 0; frame < 8; ++frame) {
    set_frame(&scene, frame);
    EXPECT_EQ(scene.diagonal(), diagonal);
    for (const glm::vec3& p : scene.positions) {
      EXPECT_TRUE(glm::all(glm::lessThanEqual(low, p)) && glm::all(glm::lessThanEqual(p, high)));
      touched |= p.y == high.y;
    }
  }
  EXPECT_TRUE(touched);
}

// The planes of a camera or light that stands still stay; those of one that moves fit each of its poses.
TEST_F(Animated, DepthRangesHoldInEveryFrame) {
  // The ring comes nearer to the camera than anything is in the first frame.
  for (const std::string& text : {with("0.4, 1.2, -0.2", "0.1, 1.2, 2.2"), with_sun()}) {
    Scene scene = load_text(text);
    for (uint32_t frame = 0; frame < 8; ++frame) {
      const Light light = scene.light;
      const Camera camera = scene.camera;
      const Moved moved = set_frame(&scene, frame);
      EXPECT_EQ(moved.light, !same_bits(light, scene.light)) << frame;
      EXPECT_EQ(moved.camera, !same_bits(camera, scene.camera)) << frame;
      for (const View& view : {camera_view(scene.camera, 480, 272), light_view(scene.light)}) {
        for (const glm::vec3& p : scene.positions) {
          if (!view.project(p)) continue;
          EXPECT_GT(glm::dot(p - view.position, view.forward), view.near);
          EXPECT_LT(glm::dot(p - view.position, view.forward), view.far);
        }
      }
    }
  }
}

TEST_F(Animated, StillScenesHaveOneFrameAndTheirOldHash) {
  add_square();
  write_gltf();
  Scene scene = load_text(R"({"name": "test", "description": "a square", "geometry": {"file": "scene.gltf"},
    "views": {"A": {"camera": {"eye": [0, 0, 4], "direction": [0, 0, -1], "vfov": 45},
                    "light": {"spot": {"position": [1, 0, 3], "direction": [0, 0, -2], "fov": 60, "intensity": 4}}}},
    "default_view": "A"})");
  const std::string hash = scene.hash;
  EXPECT_EQ(
      hash,
      "c9ed8d23d7e60808be010c8d6efb1aaa");  // as it was before scenes could move: caches and reports stay
  EXPECT_EQ(frame_count(scene), 1u);
  EXPECT_FALSE(set_frame(&scene, 0).any());
  EXPECT_FALSE(scene.animation.moves.any());
  EXPECT_EQ(scene.hash, hash);
  EXPECT_THROW(set_frame(&scene, 1), std::logic_error);
}

// Frames without keys are legal: a still scene in which nothing may differ.
TEST_F(Animated, FramesWithoutKeysAreEqual) {
  Json json = Json::parse(kText);
  json["objects"][0].erase("keys");
  json["views"]["A"]["camera"].erase("keys");
  json["views"]["A"]["light"]["spot"].erase("keys");
  Scene scene = load_text(json.dump(1));
  for (uint32_t frame = 0; frame < 8; ++frame) EXPECT_FALSE(set_frame(&scene, frame).any());
  EXPECT_FALSE(scene.animation.moves.any());
}

TEST_F(Animated, UnsoundMotionIsFound) {
  const Scene good = load_text(kText);
  EXPECT_NO_THROW(check_scene(good));
  const auto expect_error = [&good](const char* part, const std::function<void(Scene*)>& spoil) {
    Scene scene = good;
    spoil(&scene);
    try {
      check_scene(scene);
      ADD_FAILURE() << part;
    } catch (const Error& e) {
      EXPECT_TRUE(contains(e.what(), part));
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_error("does not come after", [](Scene* s) { s->animation.nodes[0].translation.times = {1, 1}; });
  expect_error("not finite", [&](Scene* s) { s->animation.nodes[0].scale.values[0].x = nan; });
  expect_error("has no length", [](Scene* s) { s->animation.nodes[0].rotation.values[0] = {0, 0, 0, 0}; });
  expect_error("its parent", [](Scene* s) { s->animation.nodes[0].parent = 0; });
  expect_error("no node", [](Scene* s) { s->animation.objects[0].node = 7; });
  expect_error("not measured", [](Scene* s) { s->animation.frames = 9; });
  expect_error("is no rate", [](Scene* s) { s->animation.rate = 0; });
  expect_error("stands still but its vertex",
               [](Scene* s) { s->triangles[3].y = s->animation.objects[0].first_vertex; });
  expect_error("of another", [](Scene* s) { s->triangles.back().x = 0; });
  expect_error("after the last object", [](Scene* s) { s->animation.objects[0].triangle_count -= 1; });
  expect_error("at frame 5: it looks nowhere", [](Scene* s) {
    s->animation.camera->aim.aim = s->animation.camera->aim.position;
    s->animation.camera->aim.aim.values = {{0, 0, 1}, {0, 0, 0}};
  });
  expect_error("at frame 6: its power is negative",
               [](Scene* s) { s->animation.light->power.values[1].y = -1; });
}

}  // namespace
}  // namespace vsglbench
