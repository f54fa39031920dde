// A frame that follows its scene gives what a new one of the same pose does.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <numeric>

#include "base/file.h"
#include "frame/frame.h"
#include "method/registry.h"
#include "scene/animation.h"
#include "scene/scene_file.h"

namespace vsglbench {
namespace {

namespace fs = std::filesystem;

// Two rings, one of which stands from frame 2 on; camera and light move in the first half.
constexpr const char* kEverythingMoves = R"({
  "name": "moving", "description": "a room with two rings",
  "geometry": {"builder": "cornell"},
  "animation": {"frames": 6, "rate": 5},
  "objects": [
    {"name": "ring", "torus": {"major": 0.3, "minor": 0.1}, "interpolation": "linear",
     "material": {"base_color": [0.9, 0.4, 0.1], "roughness": 0.3, "metallic": 0.5},
     "keys": [{"time": 0, "translation": [0, 1, 0], "rotation": [0, 0, 0, 1]},
              {"time": 0.8, "translation": [0.5, 1, 0], "rotation": [0.6, 0, 0, 0.8]}]},
    {"name": "low", "torus": {"major": 0.2, "minor": 0.05}, "interpolation": "linear",
     "keys": [{"time": 0, "translation": [-0.4, 0.5, 0.3]}, {"time": 0.4, "translation": [-0.4, 0.8, 0.3]}]}],
  "views": {"A": {
    "camera": {"eye": [0, 1, 3], "direction": [0, 0, -1], "vfov": 50,
               "keys": [{"time": 0, "eye": [0, 1, 3]}, {"time": 0.6, "eye": [0.1, 1, 3]}]},
    "light": {"spot": {"position": [0.3, 1.9, 0.4], "target": [0, 0, 0], "fov": 70, "intensity": 10,
              "keys": [{"time": 0, "intensity": 10}, {"time": 0.6, "intensity": 20}]}}}},
  "default_view": "A"
})";

Device& device() {
  static Device d;
  return d;
}

Scene scene_of(const std::string& json) {
  const fs::path file =
      fs::temp_directory_path() / fmt::format("vsglbench_frame_motion_{}", ::getpid()) / "scene.json";
  fs::create_directories(file.parent_path());
  write_text(file, json);
  Scene scene = load_scene(file.string(), {data_root() / "scenes", {}});
  fs::remove_all(file.parent_path());
  return scene;
}

Scene everything_moves() { return scene_of(kEverythingMoves); }

// A ring that stands, and one of another colour that passes through its place in frame 2; eye and light
// stand.
Scene one_passes_through_another(bool standing_first) {
  const std::string standing =
      R"({"name": "standing", "torus": {"major": 0.3, "minor": 0.1}, "interpolation": "linear",
     "material": {"base_color": [0.1, 0.9, 0.1]}, "keys": [{"time": 0, "translation": [0, 1, 0]}]})";
  const std::string moving =
      R"({"name": "moving", "torus": {"major": 0.3, "minor": 0.1}, "interpolation": "linear",
     "material": {"base_color": [0.9, 0.1, 0.1]},
     "keys": [{"time": 0, "translation": [-0.4, 1, 0]}, {"time": 0.8, "translation": [0.4, 1, 0]}]})";
  const std::string objects = standing_first ? standing + "," + moving : moving + "," + standing;
  return scene_of(R"({"name": "passing", "description": "a ring passes through another",
    "geometry": {"builder": "cornell"}, "animation": {"frames": 5, "rate": 5}, "objects": [)" +
                  objects + R"(],
    "views": {"A": {"camera": {"eye": [0, 1, 3], "direction": [0, 0, -1], "vfov": 50},
      "light": {"spot": {"position": [0.3, 1.9, 0.4], "target": [0, 0.5, 0], "fov": 70, "intensity": 10}}}},
    "default_view": "A"})");
}

struct Session {
  explicit Session(const Scene& s) : kernels(device()), stage(device(), kernels, s) {}
  std::unique_ptr<Frame> frame(const FrameParameters& p, const std::string& method = "mfis",
                               const Json& parameters = Json::object()) {
    const MethodInfo& info = load_method(method, device().info());
    const uint64_t pixels = uint64_t(p.width) * p.height;
    return std::make_unique<Frame>(
        stage, info, resolve_parameters(info, parameters), p, [this, pixels](const auto& lights) {
          ++traced;
          return std::vector<uint32_t>(lights.size() * groups_for(pixels, 32), ~0u);
        });
  }
  KernelLibrary kernels;
  Stage stage;
  unsigned traced = 0;
};

FrameParameters tiny(Visibility visibility) {
  return {
      .width = 32, .height = 18, .rsm = 32, .lights = 32, .importance_lights = 32, .visibility = visibility};
}

void expect_same_maps(const DeferredTargets& a, const DeferredTargets& b, const std::string& where) {
  for (size_t i = 0; i < a.maps.size(); ++i) {
    ASSERT_EQ(bool(a.maps[i]), bool(b.maps[i]));
    if (!a.maps[i]) continue;
    EXPECT_TRUE(download_map(a.maps[i]) == download_map(b.maps[i])) << where << ", map " << i;
  }
}

// In the order of `frames`, which may go back.
void follow(Scene scene, const std::vector<uint32_t>& frames, const std::vector<Visibility>& kinds) {
  Session session(scene);
  std::vector<std::unique_ptr<Frame>> followers;
  for (const Visibility kind : kinds) followers.push_back(session.frame(tiny(kind)));
  for (const uint32_t t : frames) {
    const Moved moved = set_frame(&scene, t);
    session.stage.follow(moved);
    Session fresh(scene);
    for (size_t i = 0; i < kinds.size(); ++i) {
      const std::string where = fmt::format("frame {}, {}", t, visibility_name(kinds[i]));
      Frame& follower = *followers[i];
      follower.follow(moved);
      auto anew = fresh.frame(tiny(kinds[i]));
      follower.render_in_motion(1, nullptr);
      anew->render(1);
      expect_same_maps(follower.gbuffer(), anew->gbuffer(), where + ", gbuffer");
      expect_same_maps(follower.rsm(), anew->rsm(), where + ", rsm");
      EXPECT_TRUE(follower.results().indirect().pixels == anew->results().indirect().pixels) << where;
    }
  }
}

TEST(FrameMotion, AFollowingFrameIsANewOneToTheBit) {
  follow(everything_moves(), {0, 1, 2, 3, 4, 5, 1, 0},
         {Visibility::exact, Visibility::none, Visibility::ism, Visibility::aism});
}

TEST(FrameMotion, OfTheColonnade) {
  const Scene scene = load_scene("colonnade-dynamic", {data_root() / "scenes", {}});
  std::vector<uint32_t> frames(frame_count(scene));
  std::iota(frames.begin(), frames.end(), 0u);
  follow(scene, frames, {Visibility::exact});
}

// The test above would pass if nothing moved.
TEST(FrameMotion, FramesDiffer) {
  Scene scene = everything_moves();
  Session session(scene);
  auto frame = session.frame(tiny(Visibility::none));
  frame->render(1);
  Image before = frame->results().indirect();
  for (const uint32_t t : {1u, 2u, 3u, 4u}) {
    const Moved moved = set_frame(&scene, t);
    session.stage.follow(moved);
    frame->follow(moved);
    frame->render(1);
    Image now = frame->results().indirect();
    EXPECT_FALSE(now.pixels == before.pixels) << t;
    before = std::move(now);
  }
}

TEST(FrameMotion, OnlyWhatMovedIsUploaded) {
  Scene scene = everything_moves();
  Session session(scene);
  const auto bytes_of = [&](size_t object) {
    const MovingObject& o = scene.animation.objects.at(object);
    return o.vertex_count * sizeof(gpu::Vertex) + o.triangle_count * sizeof(glm::vec4);
  };
  const auto uploaded = [&](uint32_t t) { return session.stage.follow(set_frame(&scene, t)); };
  EXPECT_EQ(uploaded(0), 0u);
  EXPECT_EQ(uploaded(1), bytes_of(0) + bytes_of(1));
  EXPECT_EQ(uploaded(1), 0u);
  uploaded(2);
  EXPECT_EQ(uploaded(3), bytes_of(0));  // the low ring has come to rest
  uploaded(4);
  EXPECT_EQ(uploaded(5), 0u);  // as all have
}

// Of two surfaces at one depth the first object's is seen, and so it is where one of them is drawn
// beforehand.
TEST(FrameMotion, WhatIsSeenAtOneDepthDoesNotDependOnWhatIsDrawnBefore) {
  std::vector<std::vector<glm::vec4>> seen;
  for (const bool standing_first : {true, false}) {
    Scene scene = one_passes_through_another(standing_first);
    ASSERT_EQ(scene.animation.moves.objects, std::vector<uint32_t>{standing_first ? 1u : 0u});
    follow(scene, {0, 1, 2, 3, 4}, {Visibility::none});
    set_frame(&scene, 2);
    Session session(scene);
    auto frame = session.frame(tiny(Visibility::none));
    frame->render_in_motion(1, nullptr);
    seen.push_back(download_map(*frame->gbuffer().field_maps().diffuse));
  }
  EXPECT_FALSE(seen[0] == seen[1]) << "they are nowhere at one depth";
}

// Where only the eye or only the light moves, the other half is never drawn again.
TEST(FrameMotion, OfEyeAndLightThatMoveAlone) {
  for (const char* name : {"columns-walk", "ring514-turning"}) {
    Scene scene = load_scene(name, {data_root() / "scenes", {}});
    ASSERT_TRUE(scene.animation.moves.objects.empty());
    ASSERT_NE(scene.animation.moves.camera, scene.animation.moves.light);
    follow(scene, {0, 1, 2, 0}, {Visibility::none});
    Session session(scene);
    EXPECT_EQ(session.frame(tiny(Visibility::none))->render_in_motion(1, nullptr).triangles,
              scene.triangles.size());
  }
}

uint64_t triangles_of(const Scene& scene, const std::vector<uint32_t>& objects) {
  uint64_t triangles = 0;
  for (const uint32_t i : objects) triangles += scene.animation.objects.at(i).triangle_count;
  return triangles;
}

// With camera and light at rest: two halves of what moves. A timed frame draws all.
TEST(FrameMotion, WhatStandsStillIsDrawnOnce) {
  Scene scene = load_scene("colonnade-dynamic", {data_root() / "scenes", {}});
  const uint64_t moving = triangles_of(scene, scene.animation.moves.objects);
  ASSERT_GT(moving, 0u);
  ASSERT_LT(moving, scene.triangles.size() / 2);
  Session session(scene);
  auto frame = session.frame(tiny(Visibility::none));
  for (const uint32_t t : {0u, 1u, 2u}) {
    const Moved moved = set_frame(&scene, t);
    session.stage.follow(moved);
    frame->follow(moved);
    EXPECT_EQ(frame->render_in_motion(1, nullptr).triangles, 2 * moving) << t;
    EXPECT_EQ(frame->render(1).triangles, 2 * scene.triangles.size()) << t;
  }
}

TEST(FrameMotion, WhatMovesIsDrawnAnewAsAWhole) {
  Scene scene = everything_moves();
  Session session(scene);
  auto frame = session.frame(tiny(Visibility::none));
  EXPECT_EQ(frame->render_in_motion(1, nullptr).triangles, 2 * scene.triangles.size());
}

// Shadow rays of a pose do not stand for the next, though its lights be where they were.
TEST(FrameMotion, RaysAreTracedAgain) {
  Scene scene = everything_moves();
  Session session(scene);
  auto frame = session.frame(tiny(Visibility::exact));
  frame->render(1);
  frame->render(1);
  EXPECT_EQ(session.traced, 1u);
  frame->follow({});
  frame->render(1);
  EXPECT_EQ(session.traced, 1u);
  frame->follow({.objects = {0}});
  frame->render(1);
  EXPECT_EQ(session.traced, 2u);
}

// Each seed has chains of its own: in turns they give what each gives alone. Frame 0, and every frame that is
// given no state, is that of chains that start.
TEST(FrameMotion, ChainsAreCarriedOverSeedBySeed) {
  FrameParameters p = tiny(Visibility::none);
  p.progressive = 2;
  const auto frames_of = [&](const std::vector<uint32_t>& seeds, const char* chains) {
    Scene scene = everything_moves();
    Session session(scene);
    auto frame = session.frame(p, "mfis-mh", {{"steps", 2}, {"chains", chains}});
    std::map<uint32_t, Carried> carried;
    std::map<uint32_t, std::vector<std::vector<glm::vec3>>> images;
    for (uint32_t t = 0; t < 4; ++t) {
      const Moved moved = set_frame(&scene, t);
      session.stage.follow(moved);
      frame->follow(moved);
      for (const uint32_t seed : seeds) {
        frame->render_in_motion(seed, &carried[seed]);
        EXPECT_EQ(frame->memory_fault(), "");
        images[seed].push_back(frame->results().indirect().pixels);
      }
    }
    frame->render(seeds.front());
    images[seeds.front()].push_back(frame->results().indirect().pixels);
    return images;
  };
  auto both = frames_of({1, 2}, "carried"), second = frames_of({2}, "carried"),
       fresh = frames_of({1, 2}, "fresh");
  EXPECT_EQ(both[2], std::vector(second[2].begin(), second[2].begin() + 4));
  EXPECT_EQ(both[1][0], fresh[1][0]);
  EXPECT_EQ(both[2][0], fresh[2][0]);
  EXPECT_NE(both[1][1], fresh[1][1]);
  EXPECT_EQ(both[1][4], fresh[1][4]) << "a frame that is not of the animation";
}

}  // namespace
}  // namespace vsglbench
