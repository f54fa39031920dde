#include "scene/gltf_primitive.h"

#include <algorithm>
#include <cmath>

#include "scene/gltf_skin.h"

namespace vsglbench {
namespace {

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

// Normals of no length, or that are no numbers, are replaced by the area-weighted mean of their faces'
// normals.
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
    // In double: a float's square may overflow.
    if (const glm::dvec3 wide(n); glm::length(wide) > 1e-6 && std::isfinite(glm::length(wide))) {
      n = glm::vec3(glm::normalize(wide));
      continue;
    }
    n = glm::length(sums[i]) > 0 ? glm::vec3(glm::normalize(sums[i])) : glm::vec3(0, 1, 0);
    ++repaired;
  }
  return repaired;
}

// An attribute's numbers: `count` elements of `components`, or nothing when the primitive lacks it.
std::vector<double> attribute(const GltfFile& file, const tinygltf::Primitive& primitive,
                              const std::string& key, int components, size_t count, const std::string& what,
                              Numbers numbers = Numbers::finite) {
  const auto it = primitive.attributes.find(key);
  if (it == primitive.attributes.end()) return {};
  const std::string name = what + ": " + key;
  std::vector<double> values = read_accessor(file, it->second, components, name, numbers);
  if (values.size() != count * components) {
    throw file.error("{}: {} elements but {} positions", name, values.size() / components, count);
  }
  return values;
}

void read_uvs(GltfFile* file, const tinygltf::Primitive& primitive, const UvMapping& mapping,
              const std::string& what, Mesh* mesh) {
  const size_t n = mesh->positions.size();
  const std::string name = fmt::format("TEXCOORD_{}", mapping.set);
  const auto uvs = attribute(*file, primitive, name, 2, n, what);
  for (size_t i = 0; i < uvs.size(); i += 2) mesh->uvs.emplace_back(mapping({uvs[i], uvs[i + 1]}));
  if (!uvs.empty()) return;
  mesh->uvs.assign(n, glm::vec2(mapping(glm::dvec2(0))));
  if (mapping.textured && n > 0)
    file->warn(fmt::format("{}: has no {}, at which its textures are read", what, name));
}

// Tangents that are no numbers are all made anew.
void read_tangents(GltfFile* file, const tinygltf::Primitive& primitive, const std::string& what,
                   Mesh* mesh) {
  const auto numbers = attribute(*file, primitive, "TANGENT", 4, mesh->positions.size(), what, Numbers::any);
  if (!std::ranges::all_of(numbers, [](double v) { return std::isfinite(v); }))
    return file->warn(
        fmt::format("{}: some of its tangents are no numbers; they are made from its uvs", what));
  for (size_t i = 0; i < numbers.size(); i += 4)
    mesh->tangents.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3] < 0 ? -1 : 1);
}

void read_vertices(GltfFile* file, const tinygltf::Primitive& primitive, const std::string& what,
                   Mesh* mesh) {
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end()) throw file->error("{}: has no POSITION", what);
  const std::vector<double> p = read_accessor(*file, position->second, 3, what + ": POSITION");
  const size_t n = p.size() / 3;
  for (size_t i = 0; i < n; ++i) mesh->positions.emplace_back(p[3 * i], p[3 * i + 1], p[3 * i + 2]);
  const auto normals = attribute(*file, primitive, "NORMAL", 3, n, what, Numbers::any);
  for (size_t i = 0; i < normals.size(); i += 3)
    mesh->normals.emplace_back(normals[i], normals[i + 1], normals[i + 2]);
  // Without normals, given tangents mean nothing (glTF 2.0, 3.7.2.1).
  if (!normals.empty()) read_tangents(file, primitive, what, mesh);
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

// What a primitive has beside what is read; a warning names the first that has it.
void warn_of_ignored(GltfFile* file, const tinygltf::Primitive& from, bool has_skin,
                     const std::string& what) {
  const auto warn = [&](const char* thing, const char* fate) {
    file->warn_once(thing, fmt::format("{}: its {} {}", what, thing, fate));
  };
  if (from.attributes.count("COLOR_0") > 0) warn("vertex colours (COLOR_0)", "are ignored");
  const bool joints = from.attributes.count("JOINTS_0") > 0;
  if (joints && !has_skin) warn("joints", "are ignored: its node has no skin");
  if (!joints && has_skin) warn("node's skin", "is ignored: it has no joints (JOINTS_0)");
  if (!from.targets.empty()) warn("morph targets", "are ignored");
}

}  // namespace

std::optional<GltfPrimitive> read_primitive(GltfFile* file, const tinygltf::Primitive& from,
                                            const std::vector<UvMapping>& uvs,
                                            const std::vector<glm::dmat4>& joints, const std::string& what) {
  if (from.mode < TINYGLTF_MODE_POINTS || from.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
    throw file->error("{}: unknown mode {}", what, from.mode);
  }
  if (from.mode < TINYGLTF_MODE_TRIANGLES) {
    file->warn(what + ": points and lines are ignored");
    return std::nullopt;
  }
  GltfPrimitive to;
  // load_materials put the default material behind the file's own.
  const size_t materials = file->model.materials.size();
  if (from.material >= 0) element(*file, file->model.materials, from.material, what + ": material");
  to.material = from.material < 0 ? static_cast<uint32_t>(materials) : static_cast<uint32_t>(from.material);
  warn_of_ignored(file, from, !joints.empty(), what);
  read_vertices(file, from, what, &to.mesh);
  read_uvs(file, from, uvs.at(to.material), what, &to.mesh);
  read_triangles(*file, from, what, &to.mesh);
  to.skinned = !joints.empty() && from.attributes.count("JOINTS_0") > 0;
  if (to.skinned) apply_skin(*file, from, joints, what, &to.mesh);
  if (to.mesh.normals.empty()) {
    make_flat(&to.mesh);
  } else if (const size_t repaired = repair_normals(&to.mesh); repaired > 0) {
    file->warn(
        fmt::format("{}: {} normals of no length, or that are no numbers, are replaced by their faces' mean",
                    what, repaired));
  }
  return to;
}

void turn_over(Mesh* mesh) {
  for (glm::uvec3& t : mesh->triangles) std::swap(t.y, t.z);
}

}  // namespace vsglbench
