#include "report/image_labels.h"

#include "report/environment.h"

namespace vsglbench {

Labels image_labels(const std::string& content, const std::string& scene, const std::string& hash) {
  const GitState git = build_git();
  Labels labels = {{"content", content},
                   {"software", "vsglbench, commit " + git.commit + (git.dirty ? " and changes" : "")}};
  if (!scene.empty()) labels["scene"] = scene;
  if (!hash.empty()) labels["sceneHash"] = hash;
  return labels;
}

Labels radiance_image_labels(const std::string& content, const std::string& scene, const std::string& hash) {
  Labels labels = image_labels(content, scene, hash);
  labels.merge(radiance_labels());
  return labels;
}

}  // namespace vsglbench
