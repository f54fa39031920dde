// Tests only: what shot.h tells, taken from the definitions, each ray against each triangle.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "scene/builders.h"
#include "scene/mesh.h"
#include "scene/shapes.h"
#include "scene/shot.h"

namespace vsglbench::test {

struct BruteHit {
  double distance = 0;
  glm::dvec3 point{0}, normal{0};  // the normal on the ray's side
  size_t triangle = 0;
};

// Where a ray meets the plane of each triangle, and whether that point is on the inner side of its three
// edges.
inline std::optional<BruteHit> brute_hit(const Scene& scene, const glm::dvec3& origin,
                                         const glm::dvec3& direction) {
  std::optional<BruteHit> best;
  for (size_t i = 0; i < scene.triangles.size(); ++i) {
    std::array<glm::dvec3, 3> v;
    for (int k = 0; k < 3; ++k)
      v[static_cast<size_t>(k)] = glm::dvec3(scene.positions[scene.triangles[i][k]]);
    glm::dvec3 n = glm::cross(v[1] - v[0], v[2] - v[0]);
    const double along = glm::dot(n, direction);
    if (along == 0) continue;
    const double t = glm::dot(n, v[0] - origin) / along;
    if (!(t > 0) || (best && t >= best->distance)) continue;
    const glm::dvec3 p = origin + t * direction;
    bool inside = true;
    for (size_t k = 0; k < 3; ++k) inside &= glm::dot(n, glm::cross(v[(k + 1) % 3] - v[k], p - v[k])) >= 0;
    if (inside) best = BruteHit{t, p, glm::normalize(along < 0 ? n : -n), i};
  }
  return best;
}

inline bool brute_free(const Scene& scene, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 way = to - from;
  const double length = glm::length(way), clear = 1e-4 * scene.diagonal();
  const auto hit = brute_hit(scene, from + clear / length * way, way / length);
  return !hit || hit->distance > length - 2 * clear;
}

inline bool brute_sees(const Scene& scene, const View& view, const glm::dvec3& point) {
  return view.project(glm::vec3(point)) && brute_free(scene, glm::dvec3(view.position), point);
}

inline std::vector<BruteHit> brute_points(const Scene& scene, const View& view, int across, int down) {
  std::vector<BruteHit> out;
  for (int y = 0; y < down; ++y) {
    for (int x = 0; x < across; ++x) {
      glm::vec3 origin, direction;
      view.ray({(static_cast<float>(x) + 0.5f) / static_cast<float>(across),
                (static_cast<float>(y) + 0.5f) / static_cast<float>(down)},
               &origin, &direction);
      if (const auto hit = brute_hit(scene, origin, direction)) out.push_back(*hit);
    }
  }
  return out;
}

struct BruteShot {
  double seen = 0, lit_seen = 0, direct = 0, reached = 0;
};

// Of a spot. `reached`: by any of all lit points.
inline BruteShot brute_shot(const Scene& scene, const Shot& shot, int edge) {
  const View camera = camera_view(shot.camera, 1600, 900), lamp = light_view(shot.light);
  const int across = edge * 16 / 9;
  const auto seen = brute_points(scene, camera, across, edge), lit = brute_points(scene, lamp, edge, edge);
  BruteShot out;
  out.seen = static_cast<double>(seen.size()) / (across * edge);
  for (const BruteHit& p : lit)
    out.lit_seen += brute_sees(scene, camera, p.point) / static_cast<double>(lit.size());
  for (const BruteHit& p : seen) {
    const auto share = 1 / static_cast<double>(seen.size());
    out.direct += share * (glm::dot(glm::dvec3(lamp.position) - p.point, p.normal) > 0 &&
                           brute_sees(scene, lamp, p.point));
    for (const BruteHit& q : lit) {
      const glm::dvec3 way = p.point - q.point;
      if (!(glm::dot(q.normal, way) > 1e-9 && glm::dot(p.normal, way) < -1e-9) ||
          !brute_free(scene, q.point, p.point))
        continue;
      out.reached += share;
      break;
    }
  }
  return out;
}

// Geometry without a view: of a builder, or a room of the first box, seen from within, with the others in it.
inline Scene built(const std::string& builder) {
  Scene scene;
  scene.name = builder;
  build_scene(builder, Json::object(), &scene);
  return scene;
}
inline Scene room_with(const std::vector<std::pair<glm::dvec3, glm::dvec3>>& corners) {
  Scene scene;
  scene.name = "room";
  scene.materials.emplace_back();
  MeshCollector collector(&scene);
  for (const auto& [low, high] : corners) {
    Mesh mesh;
    add_box(&mesh, low, high, 1);
    if (scene.triangles.empty()) {
      for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
      for (glm::vec3& n : mesh.normals) n = -n;
    }
    collector.add(std::move(mesh), 0);
  }
  collector.finish();
  return scene;
}

}  // namespace vsglbench::test
