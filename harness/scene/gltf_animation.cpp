#include "scene/gltf_animation.h"

namespace vsglbench {
namespace {

// One channel with where it stands, for messages.
struct Channel {
  const tinygltf::Animation& animation;
  const tinygltf::AnimationChannel& channel;
  std::string what;  // "animation 0 'walk' channel 2"
};

Interpolation interpolation_of(const GltfFile& file, const std::string& name, const std::string& what) {
  if (name.empty() || name == "LINEAR") return Interpolation::linear;
  if (name == "STEP") return Interpolation::step;
  if (name == "CUBICSPLINE") return Interpolation::cubic;
  throw file.error("{}: unknown interpolation '{}'", what, name);
}

glm::dvec3 element_of(const std::vector<double>& v, size_t i, const glm::dvec3&) {
  return {v[3 * i], v[3 * i + 1], v[3 * i + 2]};
}
glm::dquat element_of(const std::vector<double>& v, size_t i, const glm::dquat&) {
  return {v[4 * i + 3], v[4 * i], v[4 * i + 1], v[4 * i + 2]};  // glTF: x, y, z, w; GLM: w first
}

template <class T>
Track<T> read_track(const GltfFile& file, const Channel& c) {
  const auto& sampler = element(file, c.animation.samplers, c.channel.sampler, c.what + ": sampler");
  Track<T> track;
  track.interpolation = interpolation_of(file, sampler.interpolation, c.what);
  track.times = read_accessor(file, sampler.input, 1, c.what + ": input");
  constexpr int kComponents = T::length();
  const std::vector<double> numbers = read_accessor(file, sampler.output, kComponents, c.what + ": output");
  const size_t count = numbers.size() / kComponents, keys = track.times.size();
  const bool cubic = track.interpolation == Interpolation::cubic;
  if (count != (cubic ? 3 : 1) * keys) throw file.error("{}: {} values at {} times", c.what, count, keys);
  for (size_t i = 0; i < keys; ++i) {
    // A cubic key is its tangent before, its value, its tangent after.
    if (cubic) track.in.push_back(element_of(numbers, 3 * i, T()));
    track.values.push_back(element_of(numbers, cubic ? 3 * i + 1 : i, T()));
    if (cubic) track.out.push_back(element_of(numbers, 3 * i + 2, T()));
  }
  if (const std::string problem = problem_of(track); !problem.empty()) {
    throw file.error("{}: {}", c.what, problem);
  }
  return track;
}

template <class T>
void add_track(GltfFile* file, const Channel& c, std::optional<Track<T>>* slot) {
  Track<T> track = read_track<T>(*file, c);
  if (slot->has_value()) {
    file->warn(fmt::format("{}: an earlier animation keys the {} of {}; this one is ignored", c.what,
                           c.channel.target_path, node_name(*file, c.channel.target_node)));
    return;
  }
  *slot = std::move(track);
}

void read_channel(GltfFile* file, const Channel& c, std::map<int, NodeTracks>* nodes) {
  const int target = c.channel.target_node;
  const std::string& path = c.channel.target_path;
  if (target < 0) return file->warn(fmt::format("{}: has no target node and is ignored", c.what));
  const auto& node = element(*file, file->model.nodes, target, c.what + ": target node");
  if (path == "weights") {
    throw file->error("{}: moves the morph targets of {}, which are not supported; leave it out of the file",
                      c.what, node_name(*file, target));
  }
  if (path != "translation" && path != "rotation" && path != "scale") {
    return file->warn(fmt::format("{}: the target path '{}' is ignored", c.what, path));
  }
  if (!node.matrix.empty()) {
    throw file->error("{}: {} has a matrix, which can't be animated", c.what, node_name(*file, target));
  }
  NodeTracks& tracks = (*nodes)[target];
  if (tracks.animation.empty()) tracks.animation = c.what.substr(0, c.what.rfind(" channel"));
  if (path == "translation") add_track(file, c, &tracks.translation);
  if (path == "rotation") add_track(file, c, &tracks.rotation);
  if (path == "scale") add_track(file, c, &tracks.scale);
}

}  // namespace

std::string node_name(const GltfFile& file, int index) {
  const std::string& name = element(file, file.model.nodes, index, "node").name;
  return name.empty() ? fmt::format("node {}", index) : fmt::format("node {} '{}'", index, name);
}

std::map<int, NodeTracks> read_animations(GltfFile* file) {
  std::map<int, NodeTracks> nodes;
  for (size_t i = 0; i < file->model.animations.size(); ++i) {
    const tinygltf::Animation& animation = file->model.animations[i];
    for (size_t k = 0; k < animation.channels.size(); ++k) {
      const std::string name = animation.name.empty() ? "" : fmt::format(" '{}'", animation.name);
      read_channel(file,
                   {animation, animation.channels[k], fmt::format("animation {}{} channel {}", i, name, k)},
                   &nodes);
    }
  }
  return nodes;
}

}  // namespace vsglbench
