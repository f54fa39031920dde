#include "scene/gltf.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>

#include "scene/gltf_file.h"
#include "scene/gltf_material.h"
#include "scene/mesh.h"

namespace vsglbench {
namespace {

constexpr size_t kMostVertices = 100'000'000;  // of all instances together

// Where a primitive is, for messages.
std::string primitive_name(const tinygltf::Mesh& mesh, int mesh_index, size_t primitive) {
  return fmt::format("mesh {}{} primitive {}", mesh_index, mesh.name.empty() ? "" : " '" + mesh.name + "'",
                     primitive);
}

// --- Nodes --------------------------------------------------------------------------------------------

glm::dmat4 local_transform(const GltfFile& file, const tinygltf::Node& node, int index) {
  const auto numbers = [&](const std::vector<double>& v, size_t count, const char* key) {
    if (!v.empty() && v.size() != count) {
      throw file.error("node {}: {} has {} numbers instead of {}", index, key, v.size(), count);
    }
    return !v.empty();
  };
  glm::dmat4 m(1);
  if (numbers(node.matrix, 16, "matrix")) {
    for (int k = 0; k < 16; ++k) m[k / 4][k % 4] = node.matrix[static_cast<size_t>(k)];
  } else {
    if (numbers(node.translation, 3, "translation")) {
      m = glm::translate(m, {node.translation[0], node.translation[1], node.translation[2]});
    }
    if (numbers(node.rotation, 4, "rotation")) {
      const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
      if (!(glm::length(q) > 0)) throw file.error("node {}: rotation is the zero quaternion", index);
      m *= glm::mat4_cast(glm::normalize(q));
    }
    if (numbers(node.scale, 3, "scale")) m = glm::scale(m, {node.scale[0], node.scale[1], node.scale[2]});
  }
  for (int k = 0; k < 16; ++k) {
    if (!std::isfinite(m[k / 4][k % 4])) throw file.error("node {}: its transform is not finite", index);
  }
  return m;
}

std::vector<int> root_nodes(const GltfFile& file) {
  const tinygltf::Model& model = file.model;
  if (!model.scenes.empty()) {
    return element(file, model.scenes, model.defaultScene < 0 ? 0 : model.defaultScene, "default scene")
        .nodes;
  }
  std::vector<bool> is_child(model.nodes.size(), false);
  for (const auto& node : model.nodes) {
    for (const int child : node.children) {
      element(file, model.nodes, child, "child node");
      is_child[static_cast<size_t>(child)] = true;
    }
  }
  std::vector<int> roots;
  for (size_t i = 0; i < is_child.size(); ++i) {
    if (!is_child[i]) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

struct Instance {
  int mesh;
  glm::dmat4 transform;
};

// All meshes of the hierarchy with their world transforms, in depth-first order. A node that is reached twice
// (a cycle, or two parents) is an error.
std::vector<Instance> instances(const GltfFile& file) {
  std::vector<Instance> out;
  std::vector<bool> visited(file.model.nodes.size(), false);
  std::vector<std::pair<int, glm::dmat4>> open;
  const auto push = [&open](const std::vector<int>& nodes, const glm::dmat4& parent) {
    for (auto it = nodes.rbegin(); it != nodes.rend(); ++it) open.emplace_back(*it, parent);
  };
  push(root_nodes(file), glm::dmat4(1));
  while (!open.empty()) {
    const auto [index, parent] = open.back();
    open.pop_back();
    const auto& node = element(file, file.model.nodes, index, "node");
    if (visited[static_cast<size_t>(index)])
      throw file.error("node {}: is in a cycle or has two parents", index);
    visited[static_cast<size_t>(index)] = true;
    const glm::dmat4 world = parent * local_transform(file, node, index);
    if (node.mesh >= 0) out.push_back({node.mesh, world});
    push(node.children, world);
  }
  return out;
}

// --- Primitives -----------------------------------------------------------------------------------------

// Vertex indices of the triangles of a list, strip or fan (glTF 2.0, 3.7.2.1).
std::vector<glm::uvec3> triangles_of(const GltfFile& file, const std::vector<uint32_t>& v, int mode,
                                     const std::string& what) {
  std::vector<glm::uvec3> out;
  const size_t n = v.size();
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    if (n % 3 != 0) throw file.error("{}: {} indices are no whole number of triangles", what, n);
    for (size_t i = 0; i < n; i += 3) out.emplace_back(v[i], v[i + 1], v[i + 2]);
  } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    for (size_t i = 0; i + 2 < n; ++i) out.emplace_back(v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]);
  } else {
    for (size_t i = 0; i + 2 < n; ++i) out.emplace_back(v[i + 1], v[i + 2], v[0]);
  }
  return out;
}

// Flat normals: every triangle gets its own three vertices (glTF 2.0, 3.7.2.1; tangents are then ignored
// too).
void make_flat(Mesh* mesh) {
  Mesh flat;
  for (const glm::uvec3& t : mesh->triangles) {
    const glm::dvec3 &a = mesh->positions[t.x], &b = mesh->positions[t.y], &c = mesh->positions[t.z];
    const glm::vec3 n =
        has_area(a, b, c) ? glm::vec3(glm::normalize(glm::cross(b - a, c - a))) : glm::vec3(0, 1, 0);
    const uint32_t first = flat.add_vertex(a, n, mesh->uvs[t.x]);
    flat.add_vertex(b, n, mesh->uvs[t.y]);
    flat.add_vertex(c, n, mesh->uvs[t.z]);
    flat.triangles.emplace_back(first, first + 1, first + 2);
  }
  *mesh = std::move(flat);
}

// Normals of no length are replaced by the area-weighted mean of their faces' normals.
size_t repair_normals(Mesh* mesh) {
  std::vector<glm::dvec3> sums(mesh->positions.size(), glm::dvec3(0));
  for (const glm::uvec3& t : mesh->triangles) {
    const glm::dvec3 n =
        glm::cross(mesh->positions[t.y] - mesh->positions[t.x], mesh->positions[t.z] - mesh->positions[t.x]);
    for (const uint32_t i : {t.x, t.y, t.z}) sums[i] += n;
  }
  size_t repaired = 0;
  for (size_t i = 0; i < sums.size(); ++i) {
    glm::vec3& n = mesh->normals[i];
    if (const glm::dvec3 wide(n); glm::length(wide) > 1e-6) {  // in double: a float's square may overflow
      n = glm::vec3(glm::normalize(wide));
      continue;
    }
    n = glm::length(sums[i]) > 0 ? glm::vec3(glm::normalize(sums[i])) : glm::vec3(0, 1, 0);
    ++repaired;
  }
  return repaired;
}

// One primitive in its own coordinates; empty tangents are made later.
struct Primitive {
  Mesh mesh;
  uint32_t material = 0;
};

// An attribute's numbers: `count` elements of `components`, or nothing when the primitive lacks it.
std::vector<double> attribute(const GltfFile& file, const tinygltf::Primitive& primitive,
                              const std::string& key, int components, size_t count, const std::string& what) {
  const auto it = primitive.attributes.find(key);
  if (it == primitive.attributes.end()) return {};
  const std::string name = what + ": " + key;
  std::vector<double> values = read_accessor(file, it->second, components, name);
  if (values.size() != count * components) {
    throw file.error("{}: {} elements but {} positions", name, values.size() / components, count);
  }
  return values;
}

void read_vertices(const GltfFile& file, const tinygltf::Primitive& primitive, const std::string& what,
                   Mesh* mesh) {
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end()) throw file.error("{}: has no POSITION", what);
  const std::vector<double> p = read_accessor(file, position->second, 3, what + ": POSITION");
  const size_t n = p.size() / 3;
  for (size_t i = 0; i < n; ++i) mesh->positions.emplace_back(p[3 * i], p[3 * i + 1], p[3 * i + 2]);
  const auto normals = attribute(file, primitive, "NORMAL", 3, n, what);
  for (size_t i = 0; i < normals.size(); i += 3)
    mesh->normals.emplace_back(normals[i], normals[i + 1], normals[i + 2]);
  const auto uvs = attribute(file, primitive, "TEXCOORD_0", 2, n, what);
  for (size_t i = 0; i < uvs.size(); i += 2) mesh->uvs.emplace_back(uvs[i], uvs[i + 1]);
  if (uvs.empty()) mesh->uvs.assign(n, glm::vec2(0));
  const auto tangents = attribute(file, primitive, "TANGENT", 4, n, what);
  for (size_t i = 0; i < tangents.size(); i += 4) {
    mesh->tangents.emplace_back(tangents[i], tangents[i + 1], tangents[i + 2], tangents[i + 3] < 0 ? -1 : 1);
  }
}

void read_triangles(const GltfFile& file, const tinygltf::Primitive& primitive, const std::string& what,
                    Mesh* mesh) {
  std::vector<uint32_t> indices;
  if (primitive.indices >= 0) {
    indices = read_indices(file, primitive.indices, what + ": indices");
  } else {
    for (uint32_t i = 0; i < mesh->positions.size(); ++i) indices.push_back(i);
  }
  for (size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= mesh->positions.size()) {
      throw file.error("{}: index {} is {}, past the {} vertices", what, i, indices[i],
                       mesh->positions.size());
    }
  }
  mesh->triangles = triangles_of(file, indices, primitive.mode, what);
}

// Nothing for points and lines.
std::optional<Primitive> read_primitive(GltfFile* file, const tinygltf::Primitive& from,
                                        const std::string& what) {
  if (from.mode < TINYGLTF_MODE_POINTS || from.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
    throw file->error("{}: unknown mode {}", what, from.mode);
  }
  if (from.mode < TINYGLTF_MODE_TRIANGLES) {
    file->warn(what + ": points and lines are ignored");
    return std::nullopt;
  }
  Primitive to;
  // load_materials put the default material behind the file's own.
  const size_t materials = file->model.materials.size();
  if (from.material >= 0) element(*file, file->model.materials, from.material, what + ": material");
  to.material = from.material < 0 ? static_cast<uint32_t>(materials) : static_cast<uint32_t>(from.material);
  read_vertices(*file, from, what, &to.mesh);
  read_triangles(*file, from, what, &to.mesh);
  if (to.mesh.normals.empty()) {
    make_flat(&to.mesh);
  } else if (const size_t repaired = repair_normals(&to.mesh); repaired > 0) {
    file->warn(fmt::format("{}: {} normals of no length are replaced by their faces' mean", what, repaired));
  }
  if (from.attributes.count("COLOR_0") > 0) file->warn("vertex colours are ignored");
  if (from.attributes.count("JOINTS_0") > 0) file->warn("skins are ignored; meshes stand in their rest pose");
  if (!from.targets.empty()) file->warn("morph targets are ignored");
  return to;
}

// Positions by M; normals by its inverse transpose (as cofactors, so that a flattening M is no division by
// 0); a mirroring M turns winding and handedness over.
Mesh transformed(Mesh mesh, const glm::dmat4& m, double unit_scale) {
  const glm::dmat3 linear(m);
  const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                            glm::cross(linear[0], linear[1]));
  const bool mirrored = glm::determinant(linear) < 0;
  for (glm::dvec3& p : mesh.positions) p = unit_scale * glm::dvec3(m * glm::dvec4(p, 1));
  for (glm::vec3& n : mesh.normals) {
    const glm::dvec3 v = (mirrored ? -1.0 : 1.0) * (cofactor * glm::dvec3(n));
    const double length = glm::length(v);
    if (length > 0) n = glm::vec3(v / length);
  }
  for (size_t i = 0; i < mesh.tangents.size(); ++i) {
    // Orthogonal to the new normal; an arbitrary frame where nothing is left of it.
    const glm::dvec3 n(mesh.normals[i]), t = linear * glm::dvec3(mesh.tangents[i]);
    const glm::dvec3 flat = t - n * glm::dot(n, t);
    const float w = (mirrored ? -1.0f : 1.0f) * mesh.tangents[i].w;
    const bool usable = glm::length(flat) > 1e-6 * glm::length(t);
    mesh.tangents[i] =
        glm::vec4(usable ? glm::vec3(glm::normalize(flat)) : any_orthogonal(mesh.normals[i]), w);
  }
  if (mirrored) {
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  }
  return mesh;
}

void check_transformed(const GltfFile& file, const Mesh& mesh, const std::string& what) {
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const double size = glm::length(mesh.positions[i]);
    if (!(size < 1e18)) throw file.error("{}: vertex {} lies {} metres off", what, i, size);
  }
}

}  // namespace

void load_gltf(const std::filesystem::path& path, double unit_scale, Scene* scene) {
  GltfFile file = read_gltf(path);
  const tinygltf::Model& model = file.model;
  load_materials(&file, scene);
  MeshCollector collector(scene);
  size_t vertices = 0;
  for (const Instance& instance : instances(file)) {
    const auto& mesh = element(file, model.meshes, instance.mesh, "mesh");
    for (size_t i = 0; i < mesh.primitives.size(); ++i) {
      const std::string what = primitive_name(mesh, instance.mesh, i);
      std::optional<Primitive> primitive = read_primitive(&file, mesh.primitives[i], what);
      if (!primitive) continue;
      vertices += primitive->mesh.positions.size();
      if (vertices > kMostVertices) throw file.error("more than {} vertices", kMostVertices);
      Mesh world = transformed(std::move(primitive->mesh), instance.transform, unit_scale);
      check_transformed(file, world, what);
      collector.add(std::move(world), primitive->material);
    }
  }
  if (scene->triangles.empty()) throw file.error("no triangles in its scene");
  scene->warnings.insert(scene->warnings.end(), file.warnings.begin(), file.warnings.end());
  collector.finish();
}

}  // namespace vsglbench
