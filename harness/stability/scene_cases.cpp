#include <cmath>
#include <limits>

#include "scene/check.h"
#include "scene/mesh.h"
#include "scene/scene_view.h"
#include "scene/shapes.h"
#include "stability/hard_cases.h"

namespace vsglbench {
namespace {

using glm::dvec3;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Material material(const char* name, const glm::vec3& color, float metallic, float roughness) {
  Material m;
  m.name = name;
  m.base_color = glm::vec4(color, 1);
  m.metallic = metallic;
  m.roughness = roughness;
  return m;
}

glm::vec3 up_for(const glm::vec3& direction) {
  return glm::normalize(glm::cross(glm::cross(direction, glm::vec3(0, 1, 0)), direction));
}

// A corner of a room with a block in it, lit from above, as a hard case changes it.
struct Corner {
  dvec3 offset{0};  // of everything, m
  Material floor = material("floor", {0.7f, 0.65f, 0.6f}, 0, 0.5f);
  Material block = material("block", {0.3f, 0.5f, 0.8f}, 0, 0.8f);
  Mesh more;  // of the block's material, apart from it

  Scene make() const {
    Scene scene;
    scene.name = "hard";
    scene.offset = offset;
    scene.materials = {floor, block};
    Mesh room, box;
    add_grid(&room, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 4, 4, 1);
    add_grid(&room, {-2, 0, -2}, {4, 0, 0}, {0, 3, 0}, 2, 2, 1);
    add_box(&box, {-0.9, 0, -0.6}, {-0.2, 0.9, 0.1}, 1);
    MeshCollector collector(&scene);
    collector.add(std::move(room), 0);
    collector.add(std::move(box), 1);
    collector.add(more, 1);
    collector.finish();
    view(&scene);
    check_scene(scene);
    return scene;
  }

 private:
  void view(Scene* scene) const {
    const auto at = [&](const dvec3& p) { return glm::vec3(p + offset - scene->origin); };
    scene->light.position = at({1.2, 2.6, 1.5});
    scene->light.direction = glm::normalize(glm::vec3(-1.2f, -2.4f, -2.0f));
    scene->light.up = up_for(scene->light.direction);
    scene->light.power = {20, 18, 15};
    scene->camera.position = at({0.3, 1.5, 4.5});
    scene->camera.direction = glm::normalize(glm::vec3(-0.2f, -0.5f, -4.5f));
    scene->camera.up = up_for(scene->camera.direction);
    fit_depth_ranges(scene);
  }
};

SceneCase corner_at(double metres) {
  Corner c;
  c.offset = dvec3(metres, -metres, metres);
  return {c.make()};
}

// A square in the middle of the floor, with normals of its own.
Mesh square(const glm::vec3& first_normal, const glm::vec3& second_normal) {
  Mesh m;
  const uint32_t a = m.add_vertex({0.2, 0.01, 0.6}, first_normal, {0, 0});
  m.add_vertex({1.0, 0.01, 0.6}, first_normal, {1, 0});
  m.add_vertex({1.0, 0.01, -0.2}, second_normal, {1, 1});
  m.add_vertex({0.2, 0.01, -0.2}, second_normal, {0, 1});
  m.triangles = {{a, a + 1, a + 2}, {a, a + 2, a + 3}};
  m.tangents.assign(4, glm::vec4(1, 0, 0, 1));
  return m;
}

SceneCase with_normals(const glm::vec3& first, const glm::vec3& second) {
  Corner c;
  c.more = square(first, second);
  return {c.make()};
}

SceneCase with_roughness(float roughness) {
  Corner c;
  c.floor = material("floor", {0.9f, 0.8f, 0.6f}, 0.7f, roughness);
  c.block = material("block", {0.8f, 0.8f, 0.9f}, 1, roughness);
  return {c.make()};
}

// Triangles without area: three corners in one point, and three in line.
SceneCase degenerate_triangles() {
  Corner c;
  Mesh& m = c.more;
  const glm::vec3 up(0, 1, 0);
  m = square(up, up);
  const uint32_t a = m.add_vertex({0, 0.5, 0.5}, up, {0, 0});
  m.add_vertex({0.5, 0.5, 0.5}, up, {1, 0});
  m.add_vertex({1, 0.5, 0.5}, up, {2, 0});
  m.tangents.assign(m.positions.size(), glm::vec4(1, 0, 0, 1));
  m.triangles.push_back({a, a, a});
  m.triangles.push_back({a, a + 1, a + 2});
  m.triangles.push_back({a, a + 1, a + 1});
  return {c.make()};
}

// The same square three times, once wound the other way round.
SceneCase duplicate_triangles() {
  Corner c;
  c.more = square({0, 1, 0}, {0, 1, 0});
  const auto triangles = c.more.triangles;
  for (const glm::uvec3& t : triangles) {
    c.more.triangles.push_back(t);
    c.more.triangles.emplace_back(t.x, t.z, t.y);
  }
  return {c.make()};
}

// A plain of 4 km, and on it a block of 4 mm.
SceneCase two_scales() {
  Corner c;
  add_grid(&c.more, {-2000, -0.01, 2000}, {4000, 0, 0}, {0, 0, -4000}, 2, 2, 1);
  add_box(&c.more, {0.5, 0, 0.5}, {0.504, 0.004, 0.504}, 1);
  return {c.make()};
}

SceneCase with_lights(uint32_t count) { return {Corner().make(), count}; }

HardCase of(const std::string& name, const std::string& what, std::function<SceneCase()> scene) {
  return {.name = name, .what = what, .scene = std::move(scene)};
}
HardCase refused(const std::string& message, HardCase c) {
  c.refusal = message;
  return c;
}

}  // namespace

std::vector<HardCase> scene_cases() {
  const glm::vec3 up(0, 1, 0);
  return {
      of("far-1e3", "a scene 1e3 m from the origin", [] { return corner_at(1e3); }),
      of("far-1e5", "a scene 1e5 m from the origin", [] { return corner_at(1e5); }),
      of("far-1e6", "a scene 1e6 m from the origin", [] { return corner_at(1e6); }),
      refused("lights can't be drawn from an RSM of",
              of("n-above-texels", "N = texels + 1", [] { return with_lights(kSceneRsm * kSceneRsm + 1); })),
      of("degenerate-triangles", "triangles without area", degenerate_triangles),
      of("duplicate-triangles", "each triangle three times, once turned over", duplicate_triangles),
      refused("normal is not of length 1",
              of("normal-nan", "a vertex normal of NaN", [=] { return with_normals(up, glm::vec3(kNan)); })),
      refused("normal is not of length 1", of("normal-zero", "a vertex normal of no length",
                                              [=] { return with_normals(up, glm::vec3(0)); })),
      of("normal-opposite", "vertex normals that point into the face",
         [=] { return with_normals(-up, -up); }),
      of("normal-through-zero", "vertex normals whose interpolation passes through 0",
         [=] { return with_normals(up, -up); }),
      of("roughness-0", "roughness 0", [] { return with_roughness(0); }),
      of("roughness-1", "roughness 1", [] { return with_roughness(1); }),
      of("two-scales", "a block of 4 mm on a plain of 4 km", two_scales),
  };
}

const std::vector<HardCase>& hard_cases() {
  static const std::vector<HardCase> all = [] {
    std::vector<HardCase> cases = half_cases();
    for (HardCase& c : scene_cases()) cases.push_back(std::move(c));
    return cases;
  }();
  return all;
}

}  // namespace vsglbench
