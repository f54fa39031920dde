// Building blocks of geometry, shared by the glTF loader and the builders.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace vsglbench {

// Triangles of one material before they join a scene. One entry a vertex; `tangents` may be empty.
struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec4> tangents;
  std::vector<glm::vec2> uvs;
  std::vector<glm::uvec3> triangles;

  uint32_t add_vertex(const glm::dvec3& position, const glm::vec3& normal, const glm::vec2& uv);
};

// Tangents from uvs (Lengyel 2001): area-weighted sums of dP/du over the triangles of a vertex, made
// orthogonal to its normal; w so that the bitangent lies along -dP/dv, up the image. An arbitrary frame where
// the uvs give none.
void make_tangents(Mesh* mesh);

// False for a triangle whose corners are equal or in line, within rounding (twice the area under 1e-12 of the
// squared edges).
bool has_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

// Any unit vector orthogonal to the unit vector n (Duff et al. 2017, "Building an Orthonormal Basis,
// Revisited").
glm::vec3 any_orthogonal(const glm::vec3& n);

// An affine transform of vertices. Positions go by M; normals by its inverse transpose (as cofactors, so that
// a flattening M is no division by 0, and they stay as they are where nothing is left); tangents by M, made
// orthogonal to the new normal, or an arbitrary frame where nothing is left. A mirroring M turns handedness
// over, and outside would be inside but for the winding, which is left to the caller.
class Placement {
 public:
  explicit Placement(const glm::dmat4& m);
  bool mirrors() const { return mirrors_; }
  glm::dvec3 point(const glm::dvec3& p) const { return glm::dvec3(m_ * glm::dvec4(p, 1)); }
  glm::vec3 normal(const glm::vec3& n) const;
  glm::vec4 tangent(const glm::vec4& t, const glm::vec3& new_normal) const;

 private:
  glm::dmat4 m_;
  glm::dmat3 linear_, cofactor_;
  bool mirrors_;
};

// Collects meshes in double precision, moved by scene->offset, then writes them into a scene as float offsets
// from the bounds' centre.
class MeshCollector {
 public:
  explicit MeshCollector(Scene* scene) : scene_(scene) {}
  // Makes tangents where the mesh has none.
  void add(Mesh mesh, uint32_t material);
  // Sets origin, positions, bounds, and warns of zero-area triangles, which are kept.
  void finish();

 private:
  Scene* scene_;
  std::vector<glm::dvec3> positions_;
};

}  // namespace vsglbench
