#include "reference/visibility.h"

#include <gtest/gtest.h>

#include "reference/footprint.h"
#include "reference/random.h"
#include "reference/test_scenes.h"
#include "scene/surface.h"

namespace vsglbench {
namespace {

std::vector<ReceiverPoint> see(const Tracer& tracer, uint32_t width, uint32_t height) {
  const ImagePlane camera(camera_view(tracer.scene().camera, width, height));
  std::vector<ReceiverPoint> receivers;
  for (uint32_t i = 0; i < width * height; ++i) {
    glm::vec3 origin, direction;
    camera.view().ray((glm::vec2(i % width, i / width) + 0.5f) / glm::vec2(width, height), &origin,
                      &direction);
    const auto hit = tracer.intersect(origin, direction);
    if (!hit || i % 17 == 3) {  // some pixels without a surface
      receivers.push_back({});
      continue;
    }
    const Surface s = surface_at(tracer.scene(), hit->triangle, hit->barycentric, -direction);
    receivers.push_back({s.position, s.geometric_normal, true});
  }
  return receivers;
}

// What the bit means, one ray at a time.
bool visible(const Tracer& tracer, const ReceiverPoint& r, const TargetPoint& t) {
  if (!r.valid || glm::dot(r.geometric_normal, t.position - r.position) <= 0) return false;
  const glm::vec3 origin = tracer.offset(r.position, r.geometric_normal), d = t.position - origin;
  const float stop = t.stop_short + tracer.epsilon(t.position), length = glm::length(d);
  return length <= stop || !tracer.occluded(origin, origin + d * (1 - stop / length));
}

TEST(Visibility, BitsEqualAScalarLoop) {
  const Scene scene = test::slab_box();
  const Tracer tracer(scene);
  std::vector<TargetPoint> targets;
  for (uint32_t i = 0; i < 23; ++i) {
    const glm::vec4 r = random4(4, Stream::light, 0, i);
    targets.push_back({glm::vec3(r) - 0.5f, i % 3 == 0 ? 0.2f * r.w : 0});
  }
  // Sizes that fill neither tiles nor words.
  for (const glm::uvec2 size :
       {glm::uvec2(61, 35), glm::uvec2(1, 1), glm::uvec2(33, 70), glm::uvec2(64, 64)}) {
    const auto receivers = see(tracer, size.x, size.y);
    uint64_t different = 0, ones = 0;
    const auto bits = compute_visibility(tracer, receivers, size.x, size.y, targets, 2);
    ASSERT_EQ(bits.words_per_light, (size.x * size.y + 31) / 32);
    ASSERT_EQ(bits.words.size(), targets.size() * bits.words_per_light);
    for (uint32_t light = 0; light < targets.size(); ++light) {
      for (uint32_t pixel = 0; pixel < receivers.size(); ++pixel) {
        const bool want = visible(tracer, receivers[pixel], targets[light]);
        different += bits.visible(light, pixel) != want;
        ones += want;
      }
    }
    // A packet's arithmetic may round a ray through an edge the other way.
    EXPECT_LE(different, 1 + targets.size() * receivers.size() / 20000) << size.x << "x" << size.y;
    if (size.x > 1) {
      EXPECT_GT(ones, targets.size() * receivers.size() / 10);
      EXPECT_LT(ones, targets.size() * receivers.size() * 9 / 10);
      EXPECT_LT(bits.rays, targets.size() * receivers.size());
    }
    EXPECT_EQ(compute_visibility(tracer, receivers, size.x, size.y, targets, 1).words, bits.words);
  }
}

// A target on a wall is seen from everywhere in an empty convex room, but for its own plane.
TEST(Visibility, ATargetOnASurfaceDoesNotHideItself) {
  const Scene scene = test::empty_box();
  const Tracer tracer(scene);
  const auto receivers = see(tracer, 48, 32);
  const std::vector<TargetPoint> targets = {
      {{0.1f, -0.5f, 0.05f}, 0}, {{0.5f, 0.12f, -0.3f}, 0}, {{0.1f, -0.53f, 0}, 0.05f}};
  const auto bits = compute_visibility(tracer, receivers, 48, 32, targets);
  for (uint32_t light = 0; light < 2; ++light) {
    for (uint32_t pixel = 0; pixel < receivers.size(); ++pixel) {
      const ReceiverPoint& r = receivers[pixel];
      const float height = r.valid ? glm::dot(r.geometric_normal, targets[light].position - r.position) : 0;
      if (std::abs(height) < 1e-5f) continue;
      EXPECT_EQ(bits.visible(light, pixel), height > 0) << light << " " << pixel;
    }
  }
  // The third lies below the floor, as the mean of a curved cluster does: only stop_short shows it. Steep
  // rays reach it.
  const ReceiverPoint above{{0.1f, 0.4f, 0}, {0, -1, 0}, true};
  EXPECT_TRUE(
      compute_visibility(tracer, std::span(&above, 1), 1, 1, std::span(&targets[2], 1)).visible(0, 0));
  const TargetPoint bare{targets[2].position, 0};
  EXPECT_FALSE(compute_visibility(tracer, std::span(&above, 1), 1, 1, std::span(&bare, 1)).visible(0, 0));
}

}  // namespace
}  // namespace vsglbench
