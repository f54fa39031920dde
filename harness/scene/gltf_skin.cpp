#include "scene/gltf_skin.h"

#include <cmath>

#include "scene/gltf_primitive.h"

namespace vsglbench {
namespace {

// The attribute `name` as four numbers a vertex, or nothing where the primitive lacks it.
std::vector<double> fours(const GltfFile& file, const tinygltf::Primitive& primitive, const std::string& name,
                          size_t count, const std::string& what) {
  const auto it = primitive.attributes.find(name);
  if (it == primitive.attributes.end()) return {};
  std::vector<double> values = read_accessor(file, it->second, 4, fmt::format("{}: {}", what, name));
  if (values.size() != 4 * count)
    throw file.error("{}: {}: {} elements but {} positions", what, name, values.size() / 4, count);
  return values;
}

// Sums of joints' matrices, one a vertex, by their weights.
struct Blend {
  std::vector<glm::dmat4> sums;
  std::vector<double> weights;
};

void add_set(const GltfFile& file, const std::vector<double>& indices, const std::vector<double>& weights,
             const std::vector<glm::dmat4>& joints, const std::string& what, Blend* blend) {
  for (size_t i = 0; i < indices.size(); ++i) {
    if (!(weights[i] > 0)) continue;  // what has no weight may name any joint
    if (indices[i] >= static_cast<double>(joints.size())) {
      throw file.error("{}: vertex {} is moved by joint {}, past the {} of its skin", what, i / 4, indices[i],
                       joints.size());
    }
    blend->sums[i / 4] += weights[i] * joints[static_cast<size_t>(indices[i])];
    blend->weights[i / 4] += weights[i];
  }
}

}  // namespace

std::vector<glm::dmat4> joint_matrices(const GltfFile& file, int index,
                                       const std::vector<glm::dmat4>& world_of_joints) {
  const auto& skin = element(file, file.model.skins, index, "skin");
  std::vector<glm::dmat4> out = world_of_joints;
  if (skin.inverseBindMatrices < 0) return out;
  const std::string what = fmt::format("skin {}: inverseBindMatrices", index);
  const std::vector<double> numbers = read_accessor(file, skin.inverseBindMatrices, 16, what);
  if (numbers.size() < 16 * out.size())
    throw file.error("{}: {} matrices for {} joints", what, numbers.size() / 16, out.size());
  for (size_t i = 0; i < out.size(); ++i) {
    glm::dmat4 inverse;
    for (int k = 0; k < 16; ++k) inverse[k / 4][k % 4] = numbers[16 * i + static_cast<size_t>(k)];
    out[i] = out[i] * inverse;
  }
  return out;
}

void apply_skin(const GltfFile& file, const tinygltf::Primitive& primitive,
                const std::vector<glm::dmat4>& joints, const std::string& what, Mesh* mesh) {
  const size_t count = mesh->positions.size();
  Blend blend{std::vector<glm::dmat4>(count, glm::dmat4(0)), std::vector<double>(count, 0)};
  for (int set = 0;; ++set) {
    const auto indices = fours(file, primitive, fmt::format("JOINTS_{}", set), count, what);
    if (indices.empty()) break;
    const auto weights = fours(file, primitive, fmt::format("WEIGHTS_{}", set), count, what);
    if (weights.empty()) throw file.error("{}: has JOINTS_{} but no WEIGHTS_{}", what, set, set);
    add_set(file, indices, weights, joints, what, &blend);
  }
  size_t mirrored = 0;
  for (size_t i = 0; i < count; ++i) {
    if (blend.weights[i] == 0) throw file.error("{}: vertex {} is moved by no joint", what, i);
    const Placement place(blend.sums[i] / blend.weights[i]);
    mesh->positions[i] = place.point(mesh->positions[i]);
    if (!mesh->normals.empty()) mesh->normals[i] = place.normal(mesh->normals[i]);
    if (!mesh->tangents.empty()) mesh->tangents[i] = place.tangent(mesh->tangents[i], mesh->normals[i]);
    mirrored += place.mirrors();
  }
  if (2 * mirrored > count) turn_over(mesh);
}

}  // namespace vsglbench
