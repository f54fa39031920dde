// Tests only: models of many kinds, and whether a picture shows all of one.
#pragma once

#include <functional>

#include "scene/shot_fixture.h"

namespace vsglbench::test {

struct Model {
  std::string name;
  Mesh mesh;
  bool place = false;  // one is within it
};

inline Mesh lathed(const std::vector<glm::dvec2>& profile) {
  Mesh mesh;
  add_lathe(&mesh, {0, 0, 0}, profile, 16, 1);
  return mesh;
}
inline std::vector<glm::dvec2> circle_profile() {
  std::vector<glm::dvec2> out;
  for (int k = 0; k <= 8; ++k) out.emplace_back(std::sin(k * M_PI / 8), 1 - std::cos(k * M_PI / 8));
  return out;
}
// A box's walls, seen from within.
inline Mesh room_of(const glm::dvec3& low, const glm::dvec3& high) {
  Mesh mesh;
  add_box(&mesh, low, high, 1);
  for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  for (glm::vec3& n : mesh.normals) n = -n;
  return mesh;
}

inline std::vector<Model> models() {
  std::vector<Model> out;
  const auto made = [&](const char* name, bool is_place, const std::function<void(Mesh*)>& build) {
    Model m{name, {}, is_place};
    build(&m.mesh);
    out.push_back(std::move(m));
  };
  out.push_back({"closed room", room_of({0, 0, 0}, {8, 3, 5}), true});
  add_box(&out.back().mesh, {2, 0, 1}, {3, 1, 2}, 1);
  out.push_back({"thick-walled room", room_of({0, 0, 0}, {8, 3, 5}), true});
  add_box(&out.back().mesh, {-0.3, -0.3, -0.3}, {8.3, 3.3, 5.3}, 1);
  out.push_back({"corridor", room_of({0, 0, 0}, {2, 2.5, 40}), true});
  made("courtyard", false, [](Mesh* m) {
    add_box(m, {-10, -0.5, -10}, {10, 0, 10}, 1);
    add_box(m, {-10, 0, -10}, {-9.5, 4, 10}, 1);
    add_box(m, {9.5, 0, -10}, {10, 4, 10}, 1);
    add_box(m, {-9.5, 0, -10}, {9.5, 4, -9.5}, 1);
    add_box(m, {-9.5, 0, 9.5}, {9.5, 4, 10}, 1);
  });
  made("box", false, [](Mesh* m) { add_box(m, {0, 0, 0}, {1, 1, 1}, 1); });
  out.push_back({"sphere", lathed(circle_profile())});
  out.push_back({"cup", lathed({{0, 0},
                                {1, 0},
                                {1, 0},
                                {1, 2.4},
                                {1, 2.4},
                                {0.9, 2.4},
                                {0.9, 2.4},
                                {0.9, 0.1},
                                {0.9, 0.1},
                                {0, 0.1}})});
  made("torus", false, [](Mesh* m) { add_torus(m, 1, 0.3, 24, 10); });
  made("pole", false, [](Mesh* m) { add_box(m, {-0.05, 0, -0.05}, {0.05, 6, 0.05}, 1); });
  made("flat plane", false, [](Mesh* m) { add_grid(m, {0, 0, 0}, {0, 0, 2}, {3, 0, 0}, 1, 1, 1); });
  made("upright plane", false, [](Mesh* m) { add_grid(m, {0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 1, 1, 1); });
  return out;
}

inline Scene scene_of(Mesh mesh) {
  Scene scene;
  scene.name = "model";
  scene.materials.emplace_back();
  MeshCollector collector(&scene);
  collector.add(std::move(mesh), 0);
  collector.finish();
  return scene;
}

// How much of the picture's width or height is left beside the first `triangles`, at the narrowest side;
// negative where some of them is outside.
inline double margin(const Scene& scene, size_t triangles) {
  const glm::dvec3 f(scene.camera.direction), up(scene.camera.up), right = glm::cross(f, up);
  const double t = std::tan(0.5 * scene.camera.vfov);
  double least = 1;
  for (size_t i = 0; i < triangles; ++i) {
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 d =
          glm::dvec3(scene.positions[scene.triangles[i][k]]) - glm::dvec3(scene.camera.position);
      const double depth = glm::dot(d, f);
      if (!(depth > 0)) return -1;
      least = std::min({least, 0.5 - 0.5 * std::abs(glm::dot(d, up)) / (t * depth),
                        0.5 - 0.5 * std::abs(glm::dot(d, right)) / (t * depth * 16 / 9)});
    }
  }
  return least;
}

}  // namespace vsglbench::test
