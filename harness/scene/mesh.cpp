#include "scene/mesh.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace vsglbench {
namespace {

bool usable(const glm::dvec3& v) { return glm::dot(v, v) > 1e-24 && std::isfinite(glm::dot(v, v)); }

// dP/du and dP/dv of a triangle, times twice its uv area's magnitude; false where the uvs span no area.
bool uv_gradients(const Mesh& mesh, const glm::uvec3& t, glm::dvec3* du, glm::dvec3* dv) {
  const glm::dvec3 e1 = mesh.positions[t.y] - mesh.positions[t.x],
                   e2 = mesh.positions[t.z] - mesh.positions[t.x];
  const glm::dvec2 a(mesh.uvs[t.y] - mesh.uvs[t.x]), b(mesh.uvs[t.z] - mesh.uvs[t.x]);
  const double determinant = a.x * b.y - a.y * b.x;
  if (!(std::abs(determinant) > 1e-20)) return false;
  const double sign = determinant < 0 ? -1 : 1;
  *du = sign * (b.y * e1 - a.y * e2);
  *dv = sign * (a.x * e2 - b.x * e1);
  return usable(*du) && usable(*dv);
}

glm::vec4 frame_tangent(const glm::vec3& normal, const glm::dvec3& du, const glm::dvec3& dv) {
  const glm::dvec3 n(normal);
  const glm::dvec3 t = du - n * glm::dot(n, du);
  if (!usable(t)) return glm::vec4(any_orthogonal(normal), 1);
  const glm::dvec3 unit = glm::normalize(t);
  // Normal maps have y up the image, v runs down it (glTF 2.0, 3.9.3): the bitangent lies along -dP/dv.
  return glm::vec4(glm::vec3(unit), glm::dot(glm::cross(n, unit), dv) > 0 ? -1 : 1);
}

}  // namespace

uint32_t Mesh::add_vertex(const glm::dvec3& position, const glm::vec3& normal, const glm::vec2& uv) {
  positions.push_back(position);
  normals.push_back(normal);
  uvs.push_back(uv);
  return static_cast<uint32_t>(positions.size() - 1);
}

void make_tangents(Mesh* mesh) {
  std::vector<glm::dvec3> du(mesh->positions.size(), glm::dvec3(0)), dv = du;
  for (const glm::uvec3& t : mesh->triangles) {
    // Weight each triangle by its area, whatever the density of its uvs.
    glm::dvec3 u, v;
    if (!uv_gradients(*mesh, t, &u, &v)) continue;
    const double area = glm::length(
        glm::cross(mesh->positions[t.y] - mesh->positions[t.x], mesh->positions[t.z] - mesh->positions[t.x]));
    for (const uint32_t i : {t.x, t.y, t.z}) {
      du[i] += area * glm::normalize(u);
      dv[i] += area * glm::normalize(v);
    }
  }
  mesh->tangents.resize(mesh->positions.size());
  for (size_t i = 0; i < du.size(); ++i) {
    mesh->tangents[i] = frame_tangent(mesh->normals[i], du[i], dv[i]);
  }
}

bool has_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 e1 = b - a, e2 = c - a;
  const double scale = glm::dot(e1, e1) + glm::dot(e2, e2);
  return glm::length(glm::cross(e1, e2)) > 1e-12 * scale;
}

glm::vec3 any_orthogonal(const glm::vec3& n) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  return {1 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

Placement::Placement(const glm::dmat4& m)
    : m_(m),
      linear_(m),
      cofactor_(glm::cross(linear_[1], linear_[2]), glm::cross(linear_[2], linear_[0]),
                glm::cross(linear_[0], linear_[1])),
      mirrors_(glm::determinant(linear_) < 0) {}

glm::vec3 Placement::normal(const glm::vec3& n) const {
  const glm::dvec3 v = (mirrors_ ? -1.0 : 1.0) * (cofactor_ * glm::dvec3(n));
  const double length = glm::length(v);
  return length > 0 ? glm::vec3(v / length) : n;
}

glm::vec4 Placement::tangent(const glm::vec4& tangent, const glm::vec3& new_normal) const {
  const glm::dvec3 n(new_normal), t = linear_ * glm::dvec3(tangent);
  const glm::dvec3 flat = t - n * glm::dot(n, t);
  const bool usable = glm::length(flat) > 1e-6 * glm::length(t);
  return glm::vec4(usable ? glm::vec3(glm::normalize(flat)) : any_orthogonal(new_normal),
                   (mirrors_ ? -1.0f : 1.0f) * tangent.w);
}

void MeshCollector::add(Mesh mesh, uint32_t material) {
  if (mesh.tangents.empty()) make_tangents(&mesh);
  const uint32_t first_vertex = static_cast<uint32_t>(positions_.size());
  const uint32_t first_triangle = static_cast<uint32_t>(scene_->triangles.size());
  for (const glm::dvec3& p : mesh.positions) positions_.push_back(p + scene_->offset);
  scene_->normals.insert(scene_->normals.end(), mesh.normals.begin(), mesh.normals.end());
  scene_->tangents.insert(scene_->tangents.end(), mesh.tangents.begin(), mesh.tangents.end());
  scene_->uvs.insert(scene_->uvs.end(), mesh.uvs.begin(), mesh.uvs.end());
  for (const glm::uvec3& t : mesh.triangles) scene_->triangles.push_back(t + first_vertex);
  scene_->triangle_material.resize(scene_->triangles.size(), material);

  // Neighbouring meshes of one material share a batch.
  const uint32_t count = static_cast<uint32_t>(mesh.triangles.size());
  if (count == 0) return;
  if (!scene_->batches.empty() && scene_->batches.back().material == material) {
    scene_->batches.back().triangle_count += count;
  } else {
    scene_->batches.push_back({first_triangle, count, material});
  }
}

void MeshCollector::finish() {
  // Only vertices that a triangle uses count for the bounds.
  glm::dvec3 low(INFINITY), high(-INFINITY);
  size_t flat = 0;
  for (const glm::uvec3& t : scene_->triangles) {
    const glm::dvec3 &a = positions_[t.x], &b = positions_[t.y], &c = positions_[t.z];
    low = glm::min(low, glm::min(a, glm::min(b, c)));
    high = glm::max(high, glm::max(a, glm::max(b, c)));
    if (!has_area(a, b, c)) ++flat;
  }
  if (scene_->triangles.empty()) low = high = glm::dvec3(0);
  if (flat > 0) {
    scene_->warnings.push_back(fmt::format("{} of {} triangles have no area; they are kept and never hit",
                                           flat, scene_->triangles.size()));
  }

  scene_->origin = 0.5 * (low + high);
  scene_->bounds_min = glm::vec3(low - scene_->origin);
  scene_->bounds_max = glm::vec3(high - scene_->origin);
  scene_->positions.reserve(positions_.size());
  for (const glm::dvec3& p : positions_) scene_->positions.push_back(glm::vec3(p - scene_->origin));
}

}  // namespace vsglbench
