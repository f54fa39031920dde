#include "scene/animation.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>

#include "base/error.h"
#include "scene/check.h"
#include "scene/depth_range.h"
#include "scene/view_motion.h"

namespace vsglbench {
namespace {

constexpr double kMostPosedVertices = 2e8;  // in all frames together; some ten seconds
constexpr double kLargestLength = 1e18;     // metres

// Writes `value`; whether it was another.
template <class T>
bool replace(T* slot, const T& value) {
  const bool differs = !same_bits(*slot, value);
  *slot = value;
  return differs;
}

// Writes the object's vertices in the pose that `world` gives it; whether any differs from the one before.
bool pose(const MovingObject& object, const glm::dmat4& world, Scene* scene) {
  const Placement place(world);
  bool moved = false;
  for (uint32_t i = 0; i < object.vertex_count; ++i) {
    const uint32_t v = object.first_vertex + i;
    const glm::dvec3 p = object.unit * place.point(object.positions[i]) + scene->offset;
    const glm::vec3 normal = place.normal(object.normals[i]);
    moved |= replace(&scene->positions[v], glm::vec3(p - scene->origin));
    moved |= replace(&scene->normals[v], normal);
    moved |= replace(&scene->tangents[v], place.tangent(object.tangents[i], normal));
  }
  return moved;
}

void pose_objects(Scene* scene, double time, std::vector<uint32_t>* moved) {
  const Animation& animation = scene->animation;
  if (animation.nodes.empty()) return;
  const std::vector<glm::dmat4> worlds = world_transforms(animation, time);
  for (uint32_t i = 0; i < animation.objects.size(); ++i) {
    if (pose(animation.objects[i], worlds[animation.objects[i].node], scene)) moved->push_back(i);
  }
}

bool pose_camera(Scene* scene, double time) {
  const Camera camera = posed(*scene->animation.camera, *scene, time);
  if (!replace(&scene->camera, camera)) return false;
  fit_camera_depth(scene);
  return true;
}

bool pose_light(Scene* scene, double time) {
  std::optional<glm::vec3>& place = scene->animation.sun_place;
  const Light light = posed(*scene->animation.light, *scene, time);
  Light before = scene->light;
  if (place) before.position = *place;
  if (same_bits(before, light)) return false;
  scene->light = light;
  if (place) place = light.position;
  fit_light_depth(scene);
  return true;
}

bool is_unit(const glm::vec3& v) { return std::abs(glm::length(v) - 1) < 1e-3f; }

// The box round an object's vertices in its present pose.
Extent extent_of(const Scene& scene, const MovingObject& object) {
  Extent box = {glm::vec3(INFINITY), glm::vec3(-INFINITY)};
  for (uint32_t v = object.first_vertex; v < object.first_vertex + object.vertex_count; ++v) {
    const glm::vec3& p = scene.positions[v];
    // Both comparisons are false for a NaN, too.
    if (!(glm::length(glm::dvec3(p)) < kLargestLength)) {
      throw fail(ErrorKind::scene, "'{}' lies {} metres off", object.name, glm::length(glm::dvec3(p)));
    }
    if (!is_unit(scene.normals[v]) || !is_unit(glm::vec3(scene.tangents[v]))) {
      throw fail(ErrorKind::scene, "'{}' has a normal or tangent that is not of length 1", object.name);
    }
    box = {glm::min(box.low, p), glm::max(box.high, p)};
  }
  return box;
}

void measure_frame(Scene* scene, uint32_t frame, std::vector<bool>* moves) {
  std::vector<uint32_t> moved;
  pose_objects(scene, frame_time(*scene, frame), &moved);
  if (frame > 0) {
    for (const uint32_t i : moved) (*moves)[i] = true;
  }
  for (MovingObject& object : scene->animation.objects) {
    const Extent box = extent_of(*scene, object);
    object.extents.push_back(box);
    scene->bounds_min = glm::min(scene->bounds_min, box.low);
    scene->bounds_max = glm::max(scene->bounds_max, box.high);
  }
}

}  // namespace

double frame_time(const Scene& scene, uint32_t frame) {
  if (frame >= frame_count(scene)) {
    throw std::logic_error(fmt::format("{}: frame {} of {}", scene.name, frame, frame_count(scene)));
  }
  return frame / scene.animation.rate;
}

Moved set_frame(Scene* scene, uint32_t frame) {
  const double time = frame_time(*scene, frame);
  Moved moved;
  pose_objects(scene, time, &moved.objects);
  if (scene->animation.camera) moved.camera = pose_camera(scene, time);
  if (scene->animation.light) moved.light = pose_light(scene, time);
  if (moved.any()) scene->hash = scene_hash(*scene);
  return moved;
}

size_t still_triangles(const Scene& scene) {
  const auto& objects = scene.animation.objects;
  return objects.empty() ? scene.triangles.size() : objects.front().first_triangle;
}

size_t still_vertices(const Scene& scene) {
  const auto& objects = scene.animation.objects;
  return objects.empty() ? scene.positions.size() : objects.front().first_vertex;
}

void add_object(Scene* scene, MovingObject object, Mesh mesh, uint32_t material) {
  if (mesh.tangents.empty()) make_tangents(&mesh);
  object.first_vertex = static_cast<uint32_t>(scene->positions.size());
  object.vertex_count = static_cast<uint32_t>(mesh.positions.size());
  object.first_triangle = static_cast<uint32_t>(scene->triangles.size());
  object.triangle_count = static_cast<uint32_t>(mesh.triangles.size());
  if (mesh.triangles.empty()) return;
  size_t flat = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    scene->triangles.push_back(t + object.first_vertex);
    flat += !has_area(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]);
  }
  if (flat > 0) {
    scene->warnings.push_back(
        fmt::format("{} of {} triangles of {} have no area; they are kept and never hit", flat,
                    object.triangle_count, object.name));
  }
  scene->triangle_material.resize(scene->triangles.size(), material);
  scene->batches.push_back({object.first_triangle, object.triangle_count, material});
  const size_t vertices = scene->positions.size() + mesh.positions.size();
  scene->positions.resize(vertices, glm::vec3(0));
  scene->normals.insert(scene->normals.end(), mesh.normals.begin(), mesh.normals.end());
  scene->tangents.insert(scene->tangents.end(), mesh.tangents.begin(), mesh.tangents.end());
  scene->uvs.insert(scene->uvs.end(), mesh.uvs.begin(), mesh.uvs.end());
  object.positions = std::move(mesh.positions);
  object.normals = std::move(mesh.normals);
  object.tangents = std::move(mesh.tangents);
  scene->animation.objects.push_back(std::move(object));
}

std::vector<glm::dmat4> world_transforms(const Animation& animation, double time) {
  std::vector<glm::dmat4> worlds;
  worlds.reserve(animation.nodes.size());
  for (const MovingNode& node : animation.nodes) {
    const glm::dmat4 local = glm::translate(glm::dmat4(1), node.translation.at(time)) *
                             glm::mat4_cast(node.rotation.at(time)) *
                             glm::scale(glm::dmat4(1), node.scale.at(time));
    glm::dmat4 world = node.fixed * local;
    if (node.parent >= 0) world = worlds[static_cast<size_t>(node.parent)] * world;
    for (int k = 0; k < 16; ++k) {
      if (!std::isfinite(world[k / 4][k % 4])) {
        throw fail(ErrorKind::scene, "the transform of '{}' is not finite", node.name);
      }
    }
    worlds.push_back(world);
  }
  return worlds;
}

void measure_motion(Scene* scene) {
  Animation& animation = scene->animation;
  if (animation.nodes.empty()) return;
  const double vertices = double(scene->positions.size() - still_vertices(*scene)) * frame_count(*scene);
  if (vertices > kMostPosedVertices) {
    throw fail(
        ErrorKind::scene, "{} vertices of moving objects in {} frames are {:.3g}; at most {:.3g} are read",
        scene->positions.size() - still_vertices(*scene), frame_count(*scene), vertices, kMostPosedVertices);
  }
  std::vector<bool> moves(animation.objects.size(), false);
  for (MovingObject& object : animation.objects) object.extents.clear();
  for (uint32_t frame = 0; frame < frame_count(*scene); ++frame) {
    try {
      measure_frame(scene, frame, &moves);
    } catch (const Error& e) {
      throw fail(ErrorKind::scene, "at frame {}, {}", frame, e.what());
    }
  }
  std::vector<uint32_t> moved;
  pose_objects(scene, 0, &moved);
  animation.moves.objects.clear();
  for (uint32_t i = 0; i < moves.size(); ++i) {
    if (moves[i]) animation.moves.objects.push_back(i);
  }
}

}  // namespace vsglbench
