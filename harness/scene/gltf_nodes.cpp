#include "scene/gltf_nodes.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scene/gltf_animation.h"
#include "scene/gltf_instancing.h"
#include "scene/gltf_skin.h"

namespace vsglbench {

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

namespace {

// Depth first through the hierarchy.
class Walk {
 public:
  Walk(GltfFile* file, Animation* animation)
      : file_(*file), animation_(*animation), visited_(file->model.nodes.size()), moving_(visited_.size()) {
    if (animation->frames > 0) {
      tracks_ = read_animations(file);
    } else if (!file->model.animations.empty()) {
      file->warn("animations are not played, since the scene is still");
    }
  }

  std::vector<GltfInstance> instances() {
    push(root_nodes(file_), {});
    while (!open_.empty()) {
      const auto [index, parent] = open_.back();
      open_.pop_back();
      visit(index, parent);
    }
    refuse_moving_skins();
    return std::move(out_);
  }

 private:
  // Where a node's children stand.
  struct Parent {
    glm::dmat4 world{1};           // of what stands still
    std::optional<uint32_t> node;  // of Animation::nodes: what moves
    std::string animation;         // that moves it
  };

  void push(const std::vector<int>& nodes, const Parent& parent) {
    for (auto it = nodes.rbegin(); it != nodes.rend(); ++it) open_.emplace_back(*it, parent);
  }

  void visit(int index, const Parent& parent) {
    const auto& node = element(file_, file_.model.nodes, index, "node");
    const auto i = static_cast<size_t>(index);
    if (visited_[i]) throw file_.error("node {}: is in a cycle or has two parents", index);
    visited_[i] = true;
    const auto tracks = tracks_.find(index);
    Parent self = parent;
    if (parent.node || tracks != tracks_.end()) {
      self.node = add_moving(node, index, parent, tracks == tracks_.end() ? nullptr : &tracks->second);
      if (!parent.node) self.animation = tracks->second.animation;
      moving_[i] = self.animation;
    } else {
      self.world = parent.world * local_transform(file_, node, index);
    }
    if (node.mesh >= 0) add_mesh(node, index, self);
    push(node.children, self);
  }

  void add_mesh(const tinygltf::Node& node, int index, const Parent& self) {
    if (node.skin >= 0) {
      out_.push_back(
          {node.mesh, self.world, self.node, joint_matrices(file_, node.skin, joints_at_rest(node.skin))});
    } else if (const auto repeats = instance_transforms(file_, node, index)) {
      for (const glm::dmat4& place : *repeats) add_instance(node.mesh, place, self);
    } else {
      out_.push_back({node.mesh, self.world, self.node, {}});
    }
  }

  // One of many: where its node moves, it is a node of its own that stands still in that one.
  void add_instance(int mesh, const glm::dmat4& place, const Parent& self) {
    if (!self.node) return out_.push_back({mesh, self.world * place, {}, {}});
    MovingNode node;
    node.name = animation_.nodes[*self.node].name;
    node.parent = static_cast<int>(*self.node);
    node.fixed = place;
    animation_.nodes.push_back(std::move(node));
    out_.push_back({mesh, self.world, static_cast<uint32_t>(animation_.nodes.size() - 1), {}});
  }

  // Where the joints of a skin stand: they may lie anywhere in the file.
  std::vector<glm::dmat4> joints_at_rest(int skin) {
    std::vector<glm::dmat4> out;
    for (const int joint : element(file_, file_.model.skins, skin, "skin").joints) {
      element(file_, file_.model.nodes, joint, "joint");
      out.push_back(world_at_rest(joint));
    }
    if (out.empty()) throw file_.error("skin {}: has no joints", skin);
    return out;
  }

  glm::dmat4 world_at_rest(int index) {
    if (parents_.empty()) find_parents();
    glm::dmat4 world(1);
    size_t steps = 0;
    for (int at = index; at >= 0; at = parents_[static_cast<size_t>(at)]) {
      if (++steps > parents_.size()) throw file_.error("node {}: is in a cycle", index);
      world = local_transform(file_, file_.model.nodes[static_cast<size_t>(at)], at) * world;
    }
    return world;
  }

  void find_parents() {
    parents_.assign(file_.model.nodes.size(), -1);
    for (size_t i = 0; i < parents_.size(); ++i) {
      for (const int child : file_.model.nodes[i].children) {
        element(file_, file_.model.nodes, child, "child node");
        parents_[static_cast<size_t>(child)] = static_cast<int>(i);
      }
    }
  }

  // A node without tracks stands still in its parent. The uppermost moving node takes in what stands still
  // above.
  uint32_t add_moving(const tinygltf::Node& from, int index, const Parent& parent, const NodeTracks* tracks) {
    MovingNode to;
    to.name = node_name(file_, index);
    if (parent.node) to.parent = static_cast<int>(*parent.node);
    if (!parent.node) to.fixed = parent.world;
    const glm::dmat4 local = local_transform(file_, from, index);  // which checks its numbers
    if (!tracks) {
      to.fixed = to.fixed * local;
    } else {
      const auto &t = from.translation, &r = from.rotation, &s = from.scale;
      if (!t.empty()) to.translation = Track(glm::dvec3(t[0], t[1], t[2]));
      if (!r.empty()) to.rotation = Track(glm::dquat(r[3], r[0], r[1], r[2]));
      if (!s.empty()) to.scale = Track(glm::dvec3(s[0], s[1], s[2]));
      if (tracks->translation) to.translation = *tracks->translation;
      if (tracks->rotation) to.rotation = *tracks->rotation;
      if (tracks->scale) to.scale = *tracks->scale;
    }
    animation_.nodes.push_back(std::move(to));
    return static_cast<uint32_t>(animation_.nodes.size() - 1);
  }

  // A skin moves by its joints alone. Its mesh is drawn at rest, which is right only as long as nothing moves
  // them.
  void refuse_moving_skins() const {
    if (tracks_.empty()) return;
    for (size_t i = 0; i < visited_.size(); ++i) {
      const tinygltf::Node& node = file_.model.nodes[i];
      if (!visited_[i] || node.skin < 0 || node.mesh < 0) continue;
      const auto& skin = element(file_, file_.model.skins, node.skin, "skin");
      for (const int mover : skin.joints) {
        const std::string animation = mover_of(mover);
        if (animation.empty()) continue;
        throw file_.error("{} moves skin {} '{}' of {}; skins are not supported: leave the animation out",
                          animation, node.skin, skin.name, node_name(file_, static_cast<int>(i)));
      }
    }
  }

  // The animation that moves a node, or "". A joint may stand outside the scene's hierarchy.
  std::string mover_of(int index) const {
    element(file_, file_.model.nodes, index, "joint");
    const auto tracks = tracks_.find(index);
    return tracks == tracks_.end() ? moving_[static_cast<size_t>(index)] : tracks->second.animation;
  }

  GltfFile& file_;
  Animation& animation_;
  std::map<int, NodeTracks> tracks_;
  std::vector<bool> visited_;
  std::vector<std::string> moving_;  // one a node: the animation that moves it
  std::vector<int> parents_;         // one a node, or -1; empty until a joint asks
  std::vector<std::pair<int, Parent>> open_;
  std::vector<GltfInstance> out_;
};

}  // namespace

std::vector<GltfInstance> gltf_instances(GltfFile* file, Animation* animation) {
  return Walk(file, animation).instances();
}

}  // namespace vsglbench
