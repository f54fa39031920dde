#include "scene/gltf.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/animation.h"
#include "scene/gltf_file.h"
#include "scene/gltf_material.h"
#include "scene/gltf_nodes.h"
#include "scene/mesh.h"

namespace vsglbench {
namespace {

constexpr size_t kMostVertices = 100'000'000;  // of all instances together
constexpr double kLargestLength = 1e18;        // metres

// Where a primitive is, for messages.
std::string primitive_name(const tinygltf::Mesh& mesh, int mesh_index, size_t primitive) {
  return fmt::format("mesh {}{} primitive {}", mesh_index, mesh.name.empty() ? "" : " '" + mesh.name + "'",
                     primitive);
}

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

void turn_over(Mesh* mesh) {
  for (glm::uvec3& t : mesh->triangles) std::swap(t.y, t.z);
}

// In world space and metres.
Mesh transformed(Mesh mesh, const glm::dmat4& m, double unit_scale) {
  const Placement place(m);
  for (glm::dvec3& p : mesh.positions) p = unit_scale * place.point(p);
  for (glm::vec3& n : mesh.normals) n = place.normal(n);
  for (size_t i = 0; i < mesh.tangents.size(); ++i) {
    mesh.tangents[i] = place.tangent(mesh.tangents[i], mesh.normals[i]);
  }
  if (place.mirrors()) turn_over(&mesh);
  return mesh;
}

void check_transformed(const GltfFile& file, const Mesh& mesh, const std::string& what) {
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const double size = glm::length(mesh.positions[i]);
    if (!(size < kLargestLength)) throw file.error("{}: vertex {} lies {} metres off", what, i, size);
  }
}

// What stands still joins the scene at once; what moves waits until the origin is known.
class Loader {
 public:
  Loader(GltfFile* file, double unit_scale, Scene* scene)
      : file_(*file), unit_scale_(unit_scale), scene_(scene), collector_(scene) {}

  void add(const GltfInstance& instance) {
    const auto& mesh = element(file_, file_.model.meshes, instance.mesh, "mesh");
    for (size_t i = 0; i < mesh.primitives.size(); ++i) {
      const std::string what = primitive_name(mesh, instance.mesh, i);
      std::optional<Primitive> primitive = read_primitive(&file_, mesh.primitives[i], what);
      if (!primitive) continue;
      vertices_ += primitive->mesh.positions.size();
      if (vertices_ > kMostVertices) throw file_.error("more than {} vertices", kMostVertices);
      if (instance.node) {
        moving_.push_back({*instance.node, *std::move(primitive)});
      } else {
        Mesh world = transformed(std::move(primitive->mesh), instance.transform, unit_scale_);
        check_transformed(file_, world, what);
        collector_.add(std::move(world), primitive->material);
      }
    }
  }

  void finish() {
    collector_.finish();
    try {
      add_moving();
      measure_motion(scene_);
    } catch (const Error& e) {
      throw file_.error("{}", e.what());
    }
  }

 private:
  struct Moving {
    uint32_t node;
    Primitive primitive;
  };

  void add_moving() {
    const std::vector<glm::dmat4> worlds = world_transforms(scene_->animation, 0);
    // Where nothing stands still, the origin is the centre of the first frame.
    if (scene_->triangles.empty()) scene_->origin = centre_of_moving(worlds);
    for (Moving& m : moving_) {
      if (Placement(worlds[m.node]).mirrors()) turn_over(&m.primitive.mesh);
      add_object(scene_, {.name = scene_->animation.nodes[m.node].name, .node = m.node, .unit = unit_scale_},
                 std::move(m.primitive.mesh), m.primitive.material);
    }
  }

  glm::dvec3 centre_of_moving(const std::vector<glm::dmat4>& worlds) const {
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (const Moving& m : moving_) {
      const Placement place(worlds[m.node]);
      for (const glm::dvec3& p : m.primitive.mesh.positions) {
        const glm::dvec3 world = unit_scale_ * place.point(p) + scene_->offset;
        low = glm::min(low, world);
        high = glm::max(high, world);
      }
    }
    const glm::dvec3 centre = 0.5 * (low + high);
    return glm::length(centre) < kLargestLength ? centre : glm::dvec3(0);
  }

  GltfFile& file_;
  double unit_scale_;
  Scene* scene_;
  MeshCollector collector_;
  std::vector<Moving> moving_;
  size_t vertices_ = 0;
};

}  // namespace

void load_gltf(const std::filesystem::path& path, double unit_scale, Scene* scene) {
  GltfFile file = read_gltf(path);
  load_materials(&file, scene);
  Loader loader(&file, unit_scale, scene);
  for (const GltfInstance& instance : gltf_instances(&file, &scene->animation)) loader.add(instance);
  scene->warnings.insert(scene->warnings.end(), file.warnings.begin(), file.warnings.end());
  loader.finish();
  if (scene->triangles.empty()) throw file.error("no triangles in its scene");
}

}  // namespace vsglbench
