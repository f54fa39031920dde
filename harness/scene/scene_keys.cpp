#include "scene/scene_keys.h"

namespace vsglbench {

KeyList::KeyList(const JsonDocument& document, const std::string& at) : document_(document) {
  const Json& json = document.root().at(Json::json_pointer(at));
  const std::string interpolation = json.value("interpolation", "linear");
  if (interpolation == "step") interpolation_ = Interpolation::step;
  if (interpolation == "cubic") interpolation_ = Interpolation::cubic;
  if (!json.contains("keys")) return;
  if (!document.root().contains("animation")) {
    throw document.error(at + "/keys",
                         "is for a scene with 'animation', which says how many frames there are");
  }
  for (size_t i = 0; i < json["keys"].size(); ++i) {
    const std::string key = fmt::format("{}/keys/{}", at, i);
    const double time = json["keys"][i].at("time").get<double>();
    if (!keys_.empty() && !(time > keys_.back().time)) {
      throw document.error(key + "/time",
                           fmt::format("is {}, which does not come after {}", time, keys_.back().time));
    }
    keys_.push_back({key, time});
  }
}

bool KeyList::has(const Key& key, const std::string& property) const {
  return document_.root().contains(Json::json_pointer(key.at + "/" + property));
}

void KeyList::refuse(const std::string& property, const std::string& why) const {
  for (const Key& key : keys_) {
    if (has(key, property)) throw document_.error(key.at + "/" + property, why);
  }
}

}  // namespace vsglbench
