// All that is wrong with a scene.json, found in one go.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/error_list.h"
#include "base/json_violations.h"

namespace vsglbench {

class SceneProblems {
 public:
  // Begins with what the schema refuses.
  SceneProblems(const JsonDocument& document, const Json& schema);

  const JsonDocument& document() const { return document_; }

  // Whether the document has a value at a pointer that the schema takes, with all below it.
  bool sound(const std::string& pointer) const;
  // Runs check(pointer) where that is sound, and keeps the Error it throws.
  void check(const std::string& pointer, const std::function<void(const std::string&)>& check);
  void add(const Error& error);
  bool any() const { return !lines_.empty(); }

  // Throws what was found, Error where it is one thing and ErrorList where it is several, if it is anything.
  void raise() const;

 private:
  const JsonDocument& document_;
  std::vector<SchemaViolation> refused_;
  std::vector<std::string> lines_;
};

}  // namespace vsglbench
