// Animations of a glTF file (glTF 2.0, 3.11 and Appendix C).
#pragma once

#include <map>
#include <optional>

#include "scene/gltf_file.h"
#include "scene/track.h"

namespace vsglbench {

// What animations key of a node.
struct NodeTracks {
  std::string animation;  // the first that does, for messages
  std::optional<Track<glm::dvec3>> translation, scale;
  std::optional<Track<glm::dquat>> rotation;
};

// By node index. All animations of the file play together; where two key the same property of a node, the
// first counts, with a warning. Error(scene) for anything malformed, and for animated morph targets, which
// are not read.
std::map<int, NodeTracks> read_animations(GltfFile* file);

// "node 3 'door'".
std::string node_name(const GltfFile& file, int index);

}  // namespace vsglbench
