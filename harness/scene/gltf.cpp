#include "scene/gltf.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/animation.h"
#include "scene/gltf_file.h"
#include "scene/gltf_material.h"
#include "scene/gltf_nodes.h"
#include "scene/gltf_primitive.h"
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
  Loader(GltfFile* file, double unit_scale, std::vector<UvMapping> uvs, Scene* scene)
      : file_(*file), unit_scale_(unit_scale), uvs_(std::move(uvs)), scene_(scene), collector_(scene) {}

  void add(const GltfInstance& instance) {
    const auto& mesh = element(file_, file_.model.meshes, instance.mesh, "mesh");
    for (size_t i = 0; i < mesh.primitives.size(); ++i) {
      const std::string what = primitive_name(mesh, instance.mesh, i);
      std::optional<GltfPrimitive> primitive =
          read_primitive(&file_, mesh.primitives[i], uvs_, instance.joints, what);
      if (!primitive) continue;
      vertices_ += primitive->mesh.positions.size();
      if (vertices_ > kMostVertices) throw file_.error("more than {} vertices", kMostVertices);
      if (instance.node && !primitive->skinned) {
        moving_.push_back({*instance.node, *std::move(primitive)});
      } else {
        const glm::dmat4 place = primitive->skinned ? glm::dmat4(1) : instance.transform;
        Mesh world = transformed(std::move(primitive->mesh), place, unit_scale_);
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
    GltfPrimitive primitive;
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
  std::vector<UvMapping> uvs_;  // of each material
  Scene* scene_;
  MeshCollector collector_;
  std::vector<Moving> moving_;
  size_t vertices_ = 0;
};

// Which materials the primitives of these instances have; the default one is not among the file's.
std::vector<bool> used_materials(const GltfFile& file, const std::vector<GltfInstance>& instances) {
  std::vector<bool> used(file.model.materials.size(), false);
  for (const GltfInstance& instance : instances) {
    for (const auto& primitive : element(file, file.model.meshes, instance.mesh, "mesh").primitives) {
      if (primitive.material >= 0 && static_cast<size_t>(primitive.material) < used.size())
        used[static_cast<size_t>(primitive.material)] = true;
    }
  }
  return used;
}

void warn_of_cameras(GltfFile* file) {
  constexpr size_t kShown = 8;
  const auto& cameras = file->model.cameras;
  if (cameras.empty()) return;
  std::string list;
  for (size_t i = 0; i < std::min(cameras.size(), kShown); ++i) {
    list += i > 0 ? ", " : "";
    list += cameras[i].name.empty() ? fmt::format("camera {}", i) : fmt::format("'{}'", cameras[i].name);
  }
  if (cameras.size() > kShown) list += fmt::format(" and {} more", cameras.size() - kShown);
  file->warn(fmt::format("its cameras are not used: {}", list));
}

}  // namespace

void load_gltf(const std::filesystem::path& path, double unit_scale, Scene* scene) {
  GltfFile file = read_gltf(path);
  const std::vector<GltfInstance> instances = gltf_instances(&file, &scene->animation);
  std::vector<UvMapping> uvs = load_materials(&file, used_materials(file, instances), scene);
  Loader loader(&file, unit_scale, std::move(uvs), scene);
  for (const GltfInstance& instance : instances) loader.add(instance);
  warn_of_cameras(&file);
  file.end_warnings();
  scene->warnings.insert(scene->warnings.end(), file.warnings.begin(), file.warnings.end());
  loader.finish();
  if (scene->triangles.empty()) throw file.error("no triangles in its scene");
}

}  // namespace vsglbench
