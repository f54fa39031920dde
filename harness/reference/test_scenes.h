// Small scenes for this room's tests, made of quads; nothing from a file.
#pragma once

#include "scene/animation.h"
#include "scene/check.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "scene/shapes.h"

namespace vsglbench::test {

// Lambert of the given reflectance: specular 0.
inline Material lambert(const glm::vec3& reflectance) {
  Material m;
  m.base_color = glm::vec4(reflectance, 1);
  m.specular = 0;
  return m;
}

inline Material mirror(float phong_exponent, const glm::vec3& color) {
  Material m;
  m.base_color = glm::vec4(color, 1);
  m.metallic = 1;
  m.phong_exponent = phong_exponent;
  return m;
}

// A parallelogram corner + s a + t b, uv = (s, t), normal a x b.
struct Quad {
  glm::dvec3 corner, a, b;
  uint32_t material = 0;
};

inline Mesh quad_mesh(const Quad& q) {
  Mesh mesh;
  const glm::vec3 n(glm::normalize(glm::cross(q.a, q.b)));
  mesh.add_vertex(q.corner, n, {0, 0});
  mesh.add_vertex(q.corner + q.a, n, {1, 0});
  mesh.add_vertex(q.corner + q.a + q.b, n, {1, 1});
  mesh.add_vertex(q.corner + q.b, n, {0, 1});
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// Light and camera positions are given in the quads' own coordinates.
inline Scene make_scene(const std::vector<Quad>& quads, std::vector<Material> materials, Light light,
                        Camera camera) {
  Scene scene;
  scene.name = "quads";
  scene.materials = std::move(materials);
  MeshCollector collector(&scene);
  for (const Quad& q : quads) collector.add(quad_mesh(q), q.material);
  collector.finish();
  light.position = glm::vec3(glm::dvec3(light.position) - scene.origin);
  camera.position = glm::vec3(glm::dvec3(camera.position) - scene.origin);
  scene.light = light;
  scene.camera = camera;
  check_scene(scene);
  scene.hash = scene_hash(scene);
  return scene;
}

inline Light spot(const glm::vec3& position, const glm::vec3& direction, float fov,
                  const glm::vec3& up = {0, 0, 1}) {
  Light light;
  light.position = position;
  light.direction = glm::normalize(direction);
  light.up = glm::normalize(up - glm::dot(up, light.direction) * light.direction);
  light.fov = fov;
  return light;
}

inline Camera camera_at(const glm::vec3& position, const glm::vec3& target, float vfov,
                        const glm::vec3& up = {0, 1, 0}) {
  Camera camera;
  camera.position = position;
  camera.direction = glm::normalize(target - position);
  camera.up = glm::normalize(up - glm::dot(up, camera.direction) * camera.direction);
  camera.vfov = vfov;
  return camera;
}

// The six sides of the unit cube, facing in; material 0 floor and ceiling and back, 1 left, 2 right.
inline std::vector<Quad> box_quads() {
  return {{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 0}, {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 0},
          {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0}, {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, 0},
          {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1}, {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 2}};
}

// A convex room lit in its right half from the ceiling; every surface sees every other.
inline Scene empty_box(const Material& floor = lambert({0.7f, 0.7f, 0.7f})) {
  return make_scene(box_quads(), {floor, lambert({0.6f, 0.1f, 0.1f}), lambert({0.1f, 0.5f, 0.1f})},
                    spot({0.5f, 0.95f, 0.5f}, {0.5f, -1, -0.3f}, 0.9f),
                    camera_at({0.3f, 0.5f, 0.95f}, {0.5f, 0.4f, 0}, 1.0f));
}

// The same room with a slab standing in it, of a material of its own.
inline Scene slab_box(const Material& slab = lambert({0.5f, 0.5f, 0.6f})) {
  std::vector<Quad> quads = box_quads();
  quads.push_back({{0.55, 0, 0.3}, {0.3, 0, 0.15}, {0, 0.5, 0}, 3});
  return make_scene(
      quads, {lambert({0.7f, 0.7f, 0.7f}), lambert({0.6f, 0.1f, 0.1f}), lambert({0.1f, 0.5f, 0.1f}), slab},
      spot({0.5f, 0.95f, 0.6f}, {0.3f, -1, -0.3f}, 0.9f),
      camera_at({0.3f, 0.5f, 0.95f}, {0.5f, 0.4f, 0}, 1.0f));
}

// The empty room and a ring in it that rests in frame 0, moves and turns, and is back in the last frame but
// one.
inline Scene ring_box(uint32_t frames = 8) {
  Scene scene = empty_box();
  scene.animation.frames = frames;
  scene.animation.rate = 1;
  MovingNode node;
  node.name = "ring";
  const double back = frames - 2.0;
  node.translation.times = {0, back / 3, back / 1.5, back};
  node.translation.values = {{0.3, 0.3, 0.4}, {0.5, 0.4, 0.4}, {0.7, 0.2, 0.3}, {0.3, 0.3, 0.4}};
  node.rotation.times = {0, back / 2, back};
  node.rotation.values = {{1, 0, 0, 0}, {0.6, 0, 0.64, 0.48}, {1, 0, 0, 0}};
  scene.animation.nodes.push_back(node);
  Mesh mesh;
  add_torus(&mesh, 0.12, 0.04, 157, 7);
  scene.materials.push_back(lambert({0.8f, 0.5f, 0.2f}));
  add_object(&scene, {.name = "ring"}, std::move(mesh), static_cast<uint32_t>(scene.materials.size() - 1));
  measure_motion(&scene);
  check_scene(scene);
  scene.hash = scene_hash(scene);
  return scene;
}

}  // namespace vsglbench::test
