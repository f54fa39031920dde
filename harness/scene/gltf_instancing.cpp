#include "scene/gltf_instancing.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace vsglbench {
namespace {

constexpr const char* kExtension = "EXT_mesh_gpu_instancing";

// One of the three attributes, or nothing where the node lacks it.
std::vector<double> attribute(const GltfFile& file, const tinygltf::Value& attributes, const char* name,
                              int components, const std::string& what) {
  if (!attributes.Has(name)) return {};
  const tinygltf::Value& index = attributes.Get(name);
  if (!index.IsInt()) throw file.error("{}: {} is no accessor", what, name);
  return read_accessor(file, index.GetNumberAsInt(), components, fmt::format("{}: {}", what, name));
}

}  // namespace

std::optional<std::vector<glm::dmat4>> instance_transforms(const GltfFile& file, const tinygltf::Node& node,
                                                           int index) {
  const auto found = node.extensions.find(kExtension);
  if (found == node.extensions.end()) return std::nullopt;
  const std::string what = fmt::format("node {}: {}", index, kExtension);
  const tinygltf::Value& attributes = found->second.Get("attributes");
  const auto t = attribute(file, attributes, "TRANSLATION", 3, what);
  const auto r = attribute(file, attributes, "ROTATION", 4, what);
  const auto s = attribute(file, attributes, "SCALE", 3, what);
  const size_t count = std::max({t.size() / 3, r.size() / 4, s.size() / 3});
  for (const auto& [values, size] : {std::pair(&t, 3), std::pair(&r, 4), std::pair(&s, 3)}) {
    if (!values->empty() && values->size() != size * count)
      throw file.error("{}: its attributes have not the same number of instances", what);
  }
  std::vector<glm::dmat4> out(count, glm::dmat4(1));
  for (size_t i = 0; i < count; ++i) {
    if (!t.empty()) out[i] = glm::translate(out[i], {t[3 * i], t[3 * i + 1], t[3 * i + 2]});
    if (!r.empty()) {
      const glm::dquat q(r[4 * i + 3], r[4 * i], r[4 * i + 1], r[4 * i + 2]);
      if (!(glm::length(q) > 0)) throw file.error("{}: the rotation of instance {} is zero", what, i);
      out[i] *= glm::mat4_cast(glm::normalize(q));
    }
    if (!s.empty()) out[i] = glm::scale(out[i], {s[3 * i], s[3 * i + 1], s[3 * i + 2]});
  }
  return out;
}

}  // namespace vsglbench
