#include "reference/tracer.h"

#include <gtest/gtest.h>

#include <bit>

#include "base/error.h"
#include "reference/random.h"
#include "reference/test_scenes.h"

namespace vsglbench {
namespace {

TEST(Tracer, FindsTheClosestTriangle) {
  const Scene scene = test::empty_box();
  const Tracer tracer(scene);
  // The box's centre is the origin; floor at y = -0.5.
  const auto hit = tracer.intersect({0.1f, 0.2f, 0}, {0, -2, 0});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 0.35f, 1e-6f);
  EXPECT_NEAR(glm::normalize(hit->face_normal).y * glm::normalize(hit->face_normal).y, 1, 1e-6f);
  EXPECT_FALSE(tracer.intersect({0, 5, 0}, {0, 1, 0}));
  EXPECT_FALSE(tracer.occluded({-0.4f, 0, 0}, {0.4f, 0, 0}));
  EXPECT_TRUE(tracer.occluded({-0.4f, 0, 0}, {0.6f, 0, 0}));
}

// A card with holes over a floor: base-colour alpha 0 in the left half, 1 in the right.
Scene card() {
  Scene scene =
      test::make_scene({{{-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, 0}, {{-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, 1}},
                       {test::lambert({0.5f, 0.5f, 0.5f}), test::lambert({0.5f, 0.5f, 0.5f})},
                       test::spot({0, 3, 0}, {0, -1, 0}, 0.5f), test::camera_at({0, 3, 3}, {0, 0, 0}, 1));
  Texture texture;
  texture.width = texture.height = 64;
  for (int i = 0; i < 64 * 64; ++i) {
    texture.rgba.insert(texture.rgba.end(), {255, 255, 255, static_cast<uint8_t>(i % 64 < 32 ? 0 : 255)});
  }
  scene.textures.push_back(texture);
  scene.materials[1].base_color_texture = 0;
  scene.materials[1].alpha_cutoff = 0.5f;
  return scene;
}

TEST(Tracer, AlphaMaskedTexelsAreHolesForEveryKindOfRay) {
  const Scene scene = card();
  for (const char* isa : {"", "isa=avx2", "isa=sse2"}) {
    const Tracer tracer(scene, isa);
    const float top = scene.bounds_max.y + 1, floor = scene.bounds_min.y;
    const auto through = tracer.intersect({-0.5f, top, 0.1f}, {0, -1, 0});
    const auto stopped = tracer.intersect({0.5f, top, 0.1f}, {0, -1, 0});
    ASSERT_TRUE(through && stopped);
    EXPECT_NEAR(through->distance, 2, 1e-5f);
    EXPECT_NEAR(stopped->distance, 1, 1e-5f);
    EXPECT_EQ(scene.triangle_material[through->triangle], 0u);
    EXPECT_EQ(scene.triangle_material[stopped->triangle], 1u);
    EXPECT_FALSE(tracer.occluded({-0.5f, top, 0.1f}, {-0.5f, floor + 0.01f, 0.1f}));
    EXPECT_TRUE(tracer.occluded({0.5f, top, 0.1f}, {0.5f, floor + 0.01f, 0.1f}));
  }
}

TEST(Tracer, PacketsAgreeWithSingleRaysOnEveryInstructionSet) {
  const Scene scene = card();
  for (const char* isa : {"", "isa=avx2", "isa=sse2"}) {
    const Tracer tracer(scene, isa);
    int blocked = 0, open = 0;
    for (uint32_t p = 0; p < 200; ++p) {
      SegmentPacket packet;
      uint32_t want = 0;
      for (uint32_t i = 0; i < 16; ++i) {
        const glm::vec3 a = 2.0f * glm::vec3(random4(1, Stream::light, p, i)) - 1.0f;
        const glm::vec3 b = 2.0f * glm::vec3(random4(2, Stream::light, p, i)) - 1.0f;
        for (int c = 0; c < 3; ++c) {
          packet.origin[c][i] = a[c];
          packet.direction[c][i] = b[c] - a[c];
        }
        packet.end[i] = i % 5 == 4 ? -1 : 1;
        if (i % 5 != 4) want |= uint32_t(tracer.occluded(a, b)) << i;
      }
      EXPECT_EQ(tracer.occluded(packet), want) << isa << " packet " << p;
      blocked += std::popcount(want);
      open += 16 - std::popcount(want);
    }
    EXPECT_GT(blocked, 300);
    EXPECT_GT(open, 300);
  }
}

// Points of a slanted floor far from the scene's origin and of every size: no acne, and no gap under a
// card a thousandth of the scene above.
TEST(Tracer, OffsetLeavesTheSurfaceButNotTheScene) {
  for (const double scale : {1.0, 10.0, 100.0}) {
    for (const double shift : {0.0, 3.0}) {
      Scene scene = test::make_scene({{glm::dvec3(-1, 0, -1) * scale, glm::dvec3(2, 0.7, 0.1) * scale,
                                       glm::dvec3(0.1, 0.3, 2) * scale, 0}},
                                     {test::lambert({1, 1, 1})}, test::spot({0, 1, 0}, {0, -1, 0}, 1),
                                     test::camera_at({0, 1, 1}, {0, 0, 0}, 1));
      for (glm::vec3& p : scene.positions) p += float(shift * scale);
      const Tracer tracer(scene);
      for (uint32_t i = 0; i < 2000; ++i) {
        const glm::vec4 r = random4(5, Stream::light, 0, i);
        const auto& t = scene.triangles[i % 2];
        const float su = std::sqrt(r.x), u = su * (1 - r.y), v = su * r.y;
        const glm::vec3 p =
            scene.positions[t.x] * (1 - u - v) + scene.positions[t.y] * u + scene.positions[t.z] * v;
        const glm::vec3 n = glm::normalize(glm::cross(scene.positions[t.y] - scene.positions[t.x],
                                                      scene.positions[t.z] - scene.positions[t.x]));
        glm::vec3 to = glm::normalize(glm::vec3(random4(6, Stream::light, 0, i)) - 0.5f);
        const float side = glm::dot(to, n) < 0 ? -1 : 1;
        const glm::vec3 start = tracer.offset(p, side * n);
        EXPECT_FALSE(tracer.intersect(start, to)) << scale << " " << shift << " " << i;
        EXPECT_LT(glm::distance(start, p), 1e-4 * scale * (1 + shift));
      }
    }
  }
}

// Random rays and packets by both; how many hit an object.
int expect_equal(const Tracer& a, const Tracer& b, uint64_t seed) {
  int on_objects = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    const glm::vec3 from = glm::vec3(random4(seed, Stream::light, 0, i)) - 0.5f;
    const glm::vec3 to = glm::vec3(random4(seed, Stream::pool, 0, i)) - 0.5f;
    const auto hit = a.intersect(from, to - from), other = b.intersect(from, to - from);
    EXPECT_EQ(hit.has_value(), other.has_value());
    if (hit && other) {
      EXPECT_EQ(hit->distance, other->distance);
      EXPECT_EQ(hit->triangle, other->triangle);
      EXPECT_EQ(hit->barycentric, other->barycentric);
      EXPECT_EQ(hit->face_normal, other->face_normal);
      on_objects += hit->triangle >= still_triangles(a.scene());
    }
    EXPECT_EQ(a.occluded(from, to), b.occluded(from, to));
  }
  for (uint32_t p = 0; p < 500; ++p) {
    SegmentPacket packet;
    for (uint32_t i = 0; i < 16; ++i) {
      const glm::vec3 from = glm::vec3(random4(seed, Stream::light, 1, 16 * p + i)) - 0.5f;
      const glm::vec3 to = glm::vec3(random4(seed, Stream::pool, 1, 16 * p + i)) - 0.5f;
      for (int c = 0; c < 3; ++c) packet.origin[c][i] = from[c], packet.direction[c][i] = to[c] - from[c];
      packet.end[i] = i % 5 == 4 ? -1 : 1;
    }
    EXPECT_EQ(a.occluded(packet), b.occluded(packet));
  }
  return on_objects;
}

// To the bit, frame after frame and there and back: a new tracer's hits, and those of a tracer for which
// nothing moves, whose one tree holds all triangles.
TEST(Tracer, RefittedIsAsGoodAsNew) {
  for (const char* isa : {"", "isa=avx2", "isa=sse2"}) {
    Scene scene = test::ring_box();
    Tracer refitted(scene, isa);
    for (const uint32_t frame : {0u, 1u, 2u, 5u, 3u, 7u, 0u, 4u}) {
      refitted.update(set_frame(&scene, frame));
      const Tracer anew(scene, isa);
      Scene frozen = scene;
      frozen.animation = {};
      const Tracer one_tree(frozen, isa);
      EXPECT_GT(expect_equal(refitted, anew, frame + 1), 300) << isa << " " << frame;
      expect_equal(refitted, one_tree, frame + 1);
    }
  }
}

TEST(Tracer, AMovingObjectHasItsHoles) {
  Scene scene = card();
  scene.animation.frames = 2;
  scene.animation.rate = 1;
  MovingNode node;
  node.translation.times = {0, 1};
  node.translation.values = {{0, 1.5, 0}, {0, 1.6, 0.5}};
  scene.animation.nodes.push_back(node);
  add_object(&scene, {.name = "card"}, test::quad_mesh({{-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, 1}), 1);
  measure_motion(&scene);
  Tracer tracer(scene);
  for (uint32_t frame = 0; frame < 2; ++frame) {
    tracer.update(set_frame(&scene, frame));
    const float top = scene.bounds_max.y + 1;
    const auto through = tracer.intersect({-0.5f, top, 0.1f}, {0, -1, 0});
    const auto stopped = tracer.intersect({0.5f, top, 0.1f}, {0, -1, 0});
    ASSERT_TRUE(through && stopped);
    EXPECT_EQ(through->triangle / 2, 0u);  // the floor
    EXPECT_EQ(stopped->triangle / 2, 2u);  // the moving card
    EXPECT_NEAR(stopped->distance, frame == 0 ? 1.1f : 1, 1e-5f);
  }
}

}  // namespace
}  // namespace vsglbench
