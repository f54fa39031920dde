#include "scene/gltf_views.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/gltf_nodes.h"

namespace vsglbench {
namespace {

constexpr const char* kLights = "KHR_lights_punctual";
constexpr double kDegree = 180 / std::numbers::pi;
constexpr double kWidest = 179;  // degrees

// Cameras and lights look along -z of their node, with +y up.
bool aim(const glm::dmat4& world, glm::dvec3* position, glm::dvec3* direction, glm::dvec3* up) {
  const glm::dvec3 forward = -glm::dvec3(world[2]), y(world[1]);
  *position = glm::dvec3(world[3]);
  if (!(glm::length(forward) > 0)) return false;
  *direction = glm::normalize(forward);
  const glm::dvec3 across = y - glm::dot(y, *direction) * *direction;
  if (!(glm::length(across) > 1e-9 * glm::length(y))) return false;
  *up = glm::normalize(across);
  return std::isfinite(glm::length(*position)) && std::isfinite(glm::length(*up));
}

class Reader {
 public:
  explicit Reader(const GltfFile& file) : file_(file), visited_(file.model.nodes.size()) {}

  GltfViews read() {
    std::vector<std::pair<int, glm::dmat4>> open;
    const std::vector<int> roots = root_nodes(file_);
    for (auto it = roots.rbegin(); it != roots.rend(); ++it) open.emplace_back(*it, glm::dmat4(1));
    while (!open.empty()) {
      const auto [index, parent] = open.back();
      open.pop_back();
      const tinygltf::Node& node = element(file_, file_.model.nodes, index, "node");
      if (visited_[static_cast<size_t>(index)])
        throw file_.error("node {}: is in a cycle or has two parents", index);
      visited_[static_cast<size_t>(index)] = true;
      const glm::dmat4 world = parent * local_transform(file_, node, index);
      if (node.camera >= 0) add_camera(node, world);
      if (const auto it = node.extensions.find(kLights); it != node.extensions.end())
        add_light(node, it->second, world);
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        open.emplace_back(*child, world);
    }
    return std::move(out_);
  }

 private:
  static std::string name_of(const std::string& own, const std::string& node, const char* what,
                             size_t index) {
    return !own.empty() ? own : !node.empty() ? node : fmt::format("{}-{}", what, index);
  }

  void add_camera(const tinygltf::Node& node, const glm::dmat4& world) {
    const tinygltf::Camera& from = element(file_, file_.model.cameras, node.camera, "camera");
    GltfCamera to;
    to.name = name_of(node.name, from.name, "camera", out_.cameras.size());
    to.vfov = from.perspective.yfov * kDegree;
    if (from.type != "perspective") {
      out_.notes.push_back(fmt::format("camera '{}' is left out: it is orthographic", to.name));
    } else if (!(to.vfov > 0 && to.vfov < kWidest) || !aim(world, &to.eye, &to.direction, &to.up)) {
      out_.notes.push_back(fmt::format("camera '{}' is left out: it looks nowhere", to.name));
    } else {
      out_.cameras.push_back(to);
    }
  }

  void add_light(const tinygltf::Node& node, const tinygltf::Value& extension, const glm::dmat4& world) {
    const int index = extension.Has("light") ? extension.Get("light").GetNumberAsInt() : -1;
    const tinygltf::Light& from = element(file_, file_.model.lights, index, "light");
    GltfLight to;
    to.name = name_of(node.name, from.name, "light", out_.lights.size());
    to.type = from.type == "directional" ? GltfLight::Type::sun
              : from.type == "point"     ? GltfLight::Type::point
                                         : GltfLight::Type::spot;
    if (from.type == "spot") to.fov = std::min(2 * from.spot.outerConeAngle * kDegree, kWidest);
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<size_t>(k);
      to.power[k] = from.intensity * (i < from.color.size() ? from.color[i] : 1.0) / kLumensAWatt;
    }
    const bool shines = std::max({to.power.x, to.power.y, to.power.z}) > 0 && to.fov > 0 &&
                        std::min({to.power.x, to.power.y, to.power.z}) >= 0 &&
                        std::isfinite(glm::length(to.power));
    if (!shines) {
      out_.notes.push_back(fmt::format("light '{}' is left out: it does not shine", to.name));
    } else if (!aim(world, &to.position, &to.direction, &to.up)) {
      out_.notes.push_back(fmt::format("light '{}' is left out: it shines nowhere", to.name));
    } else {
      read_rectangle(node, &to);
      out_.lights.push_back(to);
    }
  }

  // Of a sun that this programme has exported.
  static void read_rectangle(const tinygltf::Node& node, GltfLight* light) {
    if (light->type != GltfLight::Type::sun || !node.extras.IsObject() || !node.extras.Has("half_extent"))
      return;
    const tinygltf::Value& half = node.extras.Get("half_extent");
    if (!half.IsArray() || half.ArrayLen() != 2 || !half.Get(0).IsNumber() || !half.Get(1).IsNumber()) return;
    const glm::dvec2 extent(half.Get(0).GetNumberAsDouble(), half.Get(1).GetNumberAsDouble());
    if (extent.x > 0 && extent.y > 0) light->half_extent = extent;
  }

  const GltfFile& file_;
  std::vector<bool> visited_;
  GltfViews out_;
};

}  // namespace

GltfViews gltf_views(const std::filesystem::path& path) { return Reader(read_gltf(path)).read(); }

}  // namespace vsglbench
