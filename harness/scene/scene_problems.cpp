#include "scene/scene_problems.h"

#include <algorithm>

namespace vsglbench {

SceneProblems::SceneProblems(const JsonDocument& document, const Json& schema)
    : document_(document), refused_(all_violations(document, schema)) {
  for (const SchemaViolation& v : refused_) add(document.error(v.pointer, v.message));
}

bool SceneProblems::sound(const std::string& pointer) const {
  if (!document_.root().contains(Json::json_pointer(pointer))) return false;
  return std::ranges::none_of(refused_, [&](const SchemaViolation& v) {
    return v.pointer == pointer || v.pointer.starts_with(pointer + "/");
  });
}

void SceneProblems::check(const std::string& pointer, const std::function<void(const std::string&)>& check) {
  if (!sound(pointer)) return;
  try {
    check(pointer);
  } catch (const Error& e) {
    add(e);
  }
}

void SceneProblems::add(const Error& error) {
  if (std::ranges::find(lines_, error.what()) == lines_.end()) lines_.emplace_back(error.what());
}

void SceneProblems::raise() const {
  if (lines_.size() == 1) throw Error(ErrorKind::scene, lines_.front());
  if (lines_.size() > 1) throw ErrorList(ErrorKind::scene, lines_);
}

}  // namespace vsglbench
