#include "scene/builders.h"

#include "base/nearest.h"

namespace vsglbench {

const std::vector<BuilderEntry>& scene_builders() {
  static const std::vector<BuilderEntry> builders = {
      {"cornell", build_cornell}, {"ring514", build_ring}, {"colonnade", build_colonnade}};
  return builders;
}

void build_scene(const std::string& builder, const Json& parameters, Scene* scene) {
  std::vector<std::string> names;
  for (const BuilderEntry& entry : scene_builders()) {
    if (entry.name == builder) return entry.build(parameters, scene);
    names.push_back(entry.name);
  }
  throw fail(ErrorKind::scene, "unknown builder '{}'{}", builder, suggestion(builder, names));
}

}  // namespace vsglbench
