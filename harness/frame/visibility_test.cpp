// Shadow maps by themselves: one light in a box, depth by depth; and the clusters that points are made from.
#include "frame/visibility.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "frame/ism_surface.h"

using namespace vsglbench;

namespace {

Device& device() {
  static Device d;
  return d;
}

void add_quad(Scene* s, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
  const auto first = static_cast<uint32_t>(s->positions.size());
  for (const auto& p : {corner, corner + u, corner + u + v, corner + v}) {
    s->positions.push_back(p);
    s->normals.push_back(glm::normalize(glm::cross(u, v)));
    s->tangents.push_back(glm::vec4(glm::normalize(u), 1));
    s->uvs.push_back(glm::vec2(0));
  }
  s->triangles.push_back({first, first + 1, first + 2});
  s->triangles.push_back({first, first + 2, first + 3});
}

constexpr float kShelf = 0.2f, kShelfHalf = 0.35f;  // height over the box's middle, half the edge; m

// A closed box from -1 to 1 on each axis, with a thin shelf in it or without; the camera sees all of its
// ceiling.
Scene box(bool with_shelf) {
  Scene s;
  for (const float side : {-1.0f, 1.0f}) {
    add_quad(&s, {side, -1, -1}, {0, 2, 0}, {0, 0, 2});
    add_quad(&s, {-1, side, -1}, {2, 0, 0}, {0, 0, 2});
    add_quad(&s, {-1, -1, side}, {2, 0, 0}, {0, 2, 0});
  }
  if (with_shelf)
    add_quad(&s, {-kShelfHalf, kShelf, -kShelfHalf}, {2 * kShelfHalf, 0, 0}, {0, 0, 2 * kShelfHalf});
  const auto triangles = static_cast<uint32_t>(s.triangles.size());
  s.materials = {Material{}};
  s.batches = {{0, triangles, 0}};
  s.triangle_material.assign(triangles, 0);
  s.bounds_min = glm::vec3(-1);
  s.bounds_max = glm::vec3(1);
  s.camera = {.position = {0, -0.95f, 0}, .direction = {0, 1, 0}, .up = {0, 0, 1}, .vfov = 2.4f};
  return s;
}

const glm::vec3 kLight(0.1f, -1, 0.05f), kUp(0, 1, 0);

// The map of one light on the floor, as shading reads it.
std::vector<float> depth_map(const Scene& scene, Visibility technique, const IsmParameters& p) {
  KernelLibrary kernels(device());
  ShadowMapMemory memory;
  SceneGpu geometry(device(), scene);
  const DeferredTargets seen(device(), "seen", 64, 64);
  const View view = camera_view(scene.camera, 64, 64);
  const gpu::Emitter emitter = make_emitter(view, 64, 64, glm::vec3(1), true);
  Buffer viewer(device(), "viewer", sizeof emitter), lights(device(), "lights", sizeof(gpu::Vpl));
  viewer.upload(&emitter, sizeof emitter);
  const gpu::Vpl light{.position = kLight, .normal = kUp, .power = 1, .geometric_normal = kUp};
  lights.upload(&light, sizeof light);
  ImperfectShadowMaps maps(kernels, memory, scene, technique, p);
  Recorder recorder(device());
  recorder.begin();
  recorder.pass({.step = "gbuffer"}, [&] { geometry.draw(recorder, view, viewer, seen); });
  const auto made = maps.build(recorder, lights, LightKind::vpl, 1, seen);
  recorder.submit_and_wait();
  EXPECT_EQ(made.size, p.size);
  return made.depth->download<float>(size_t(p.size) * p.size);
}

// Distance along unit `d` from the light to the first surface of the box.
double analytic(const glm::dvec3& d, bool with_shelf) {
  const glm::dvec3 o(kLight);
  double nearest = 1e300;
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] != 0) nearest = std::min(nearest, ((d[axis] > 0 ? 1 : -1) - o[axis]) / d[axis]);
  }
  if (with_shelf && d.y > 0) {
    const double t = (kShelf - o.y) / d.y;
    const glm::dvec3 at = o + t * d;
    if (std::max(std::abs(at.x), std::abs(at.z)) < kShelfHalf) nearest = std::min(nearest, t);
  }
  return nearest;
}

// Direction of the coordinates p in [-1,1]² of a hemisphere's map, in the frame that ism.glsl makes about +y.
glm::dvec3 direction(const glm::dvec2& p) {
  const double x = 0.5 * (p.x + p.y), y = 0.5 * (p.x - p.y);
  return glm::normalize(glm::dvec3(x, 1 - std::abs(x) - std::abs(y), -y));
}

struct Agreement {
  int texels = 0, empty = 0;
  int right = 0;  // within 1 % of distances in the texel or, the bias for slopes, one texel around it
  double share() const { return double(right) / texels; }
};

// The least distance over a texel, and the largest over it and its neighbours.
void expect_range(uint32_t x, uint32_t y, uint32_t size, double* low, double* high) {
  constexpr int kSub = 4;
  *low = 1e300;
  *high = 0;
  for (int j = -kSub; j <= 2 * kSub; ++j) {
    for (int i = -kSub; i <= 2 * kSub; ++i) {
      const glm::dvec2 at = (glm::dvec2(x, y) + glm::dvec2(i, j) / double(kSub)) * (2.0 / size) - 1.0;
      const double d = analytic(direction(glm::clamp(at, -0.999, 0.999)), false);
      const bool within = std::min(i, j) >= 0 && std::max(i, j) <= kSub;
      if (within) *low = std::min(*low, d);
      *high = std::max(*high, d);
    }
  }
}

// Compares all texels but those at the horizon, where the map ends.
Agreement compare(const std::vector<float>& map, uint32_t size) {
  Agreement result;
  for (uint32_t y = 1; y + 1 < size; ++y) {
    for (uint32_t x = 1; x + 1 < size; ++x) {
      double low, high;
      expect_range(x, y, size, &low, &high);
      const float depth = map[size_t(y) * size + x];
      ++result.texels;
      result.empty += !std::isfinite(depth);
      result.right += depth > 0.99 * low && depth < 1.01 * high;
    }
  }
  return result;
}

Scene triangle_soup(uint32_t count) {
  Scene s;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (uint32_t i = 0; i < count; ++i) {
    const glm::vec3 at(unit(random), unit(random), unit(random));
    for (int v = 0; v < 3; ++v)
      s.positions.push_back(at +
                            (i == 7 ? 4.0f : 0.01f) * glm::vec3(unit(random), unit(random), unit(random)));
    s.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  s.triangles.push_back({0, 0, 1});  // no area
  s.bounds_min = glm::vec3(-5);
  s.bounds_max = glm::vec3(5);
  return s;
}

double area_of(const std::vector<glm::vec3>& positions, const glm::uvec3& t) {
  const glm::dvec3 a(positions[t.x]), b(positions[t.y]), c(positions[t.z]);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

}  // namespace

class ShadowMap : public ::testing::TestWithParam<Visibility> {};

TEST_P(ShadowMap, HoldsTheDistanceToTheBox) {
  for (const uint32_t size : {32u, 64u}) {
    const Agreement a = compare(depth_map(box(false), GetParam(), {.size = size}), size);
    std::printf("%s %u: %.1f %% of %d texels\n", visibility_name(GetParam()).c_str(), size, 100 * a.share(),
                a.texels);
    EXPECT_EQ(a.empty, 0) << "filling leaves no hole between points";
    EXPECT_GT(a.share(), 0.9);
  }
}

// How much of a shelf must hide what is behind it: where no point of it falls into a texel, one behind does.
double solid(Visibility technique) { return technique == Visibility::ism ? 0.5 : 0.75; }

// A shelf without thickness is in the map as far as it reaches, and no farther.
TEST_P(ShadowMap, SeesAThinOccluder) {
  const uint32_t size = 64;
  const auto with = depth_map(box(true), GetParam(), {.size = size}),
             without = depth_map(box(false), GetParam(), {.size = size});
  int inside = 0, hidden = 0, outside = 0, clear = 0;
  for (uint32_t y = 0; y < size; ++y) {
    for (uint32_t x = 0; x < size; ++x) {
      const glm::dvec2 p = (glm::dvec2(x, y) + 0.5) * (2.0 / size) - 1.0;
      if (std::max(std::abs(p.x), std::abs(p.y)) > 0.9) continue;
      const glm::dvec3 d = direction(p), at = glm::dvec3(kLight) + (kShelf + 1.0) / d.y * d;
      const double off = std::max(std::abs(at.x), std::abs(at.z)) - kShelfHalf;
      const float depth = with[size_t(y) * size + x];
      const double to_shelf = (kShelf + 1.0) / d.y;
      if (off < -0.08) {
        ++inside;
        hidden += std::abs(depth / to_shelf - 1) < 0.06;
      } else if (off > 0.15) {
        ++outside;
        clear += std::abs(depth / without[size_t(y) * size + x] - 1) < 0.15;
      }
    }
  }
  std::printf("%s: %d of %d hidden, %d of %d clear\n", visibility_name(GetParam()).c_str(), hidden, inside,
              clear, outside);
  ASSERT_GT(inside, 30);
  EXPECT_GT(hidden, solid(GetParam()) * inside);
  EXPECT_GT(clear, 0.9 * outside);
}

TEST_P(ShadowMap, SmallSizesWork) {
  for (const uint32_t points : {1u, 17u}) {
    const auto map = depth_map(box(false), GetParam(), {.size = 8, .points = points});
    for (const float depth : map) EXPECT_TRUE(depth > 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, ShadowMap,
                         ::testing::Values(Visibility::ism, Visibility::aism, Visibility::tism),
                         [](const auto& test) { return visibility_name(test.param); });

// Every map is counted, with its pyramid, and what the points come from.
TEST(ShadowMaps, MemoryIsThatOfTheBuffers) {
  KernelLibrary kernels(device());
  ShadowMapMemory memory;
  const Scene scene = box(true);
  const size_t maps = 100 * 4 * (64 * 64 + 32 * 32 + 16 * 16 + 8 * 8 + 4 * 4) + 100 * 32;
  const ImperfectShadowMaps ism(kernels, memory, scene, Visibility::ism, {}),
      tism(kernels, memory, scene, Visibility::tism, {});
  EXPECT_EQ(ism.memory_bytes(100), maps + (1u << 20) * 16);
  EXPECT_GT(tism.memory_bytes(100), maps);
  EXPECT_LT(tism.memory_bytes(100), maps + (1u << 19)) << "14 triangles, halved to 1/1024 of the area";
}

TEST(SurfaceClusters, HoldAllOfTheSurfaceOnce) {
  for (const uint32_t count : {1u, 50u, 30000u}) {
    const Scene scene = triangle_soup(count);
    const SurfaceClusters s = cluster_surface(scene);
    double expected = 0, found = 0;
    for (const auto& t : scene.triangles) expected += area_of(scene.positions, t);
    uint32_t next = 0;
    ASSERT_LE(s.clusters.size(), SurfaceClusters::kMost);
    for (const auto& c : s.clusters) {
      ASSERT_EQ(c.first, next) << "clusters follow one another";
      ASSERT_GT(c.count, 0u);
      next += c.count;
      double area = 0;
      for (uint32_t i = c.first; i < next; ++i) {
        const double a = area_of(s.positions, s.triangles[i]);
        ASSERT_LE(a, 1.001 * expected / 1024);
        area += a;
        ASSERT_NEAR(s.area[i], area, 1e-5 * area);
        for (int v = 0; v < 3; ++v)
          ASSERT_LE(glm::distance(s.positions[s.triangles[i][v]], c.centre), c.radius + 1e-6f);
      }
      EXPECT_NEAR(c.facing[0] + c.facing[1] + c.facing[2], 1, 1e-4);
      found += area;
    }
    EXPECT_EQ(next, s.triangles.size());
    EXPECT_EQ(s.area.size(), s.triangles.size());
    EXPECT_NEAR(found, expected, 1e-5 * expected);
  }
}
