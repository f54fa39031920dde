#include "run/preset.h"

#include <algorithm>

#include "base/error.h"
#include "base/file.h"
#include "base/nearest.h"
#include "method/registry.h"
#include "run/case_keys.h"
#include "run/config.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

fs::path folder() { return data_root() / "configs" / "presets"; }

// That of a config's keys, as far as a preset may have them; whatever else it holds is a method's own
// parameter.
const Json& preset_schema() {
  static const Json schema = [] {
    Json made = {{"type", "object"}, {"properties", Json::object()}};
    std::vector<std::string> keys = case_key_names();
    keys.insert(keys.end(), {"description", "frame", "ism"});
    for (const auto& key : keys) made["properties"][key] = config_schema().at("properties").at(key);
    return made;
  }();
  return schema;
}

// Throws for a key that is neither one of a preset nor a parameter of any method.
void check_keys(const JsonDocument& doc, const Json& schema) {
  std::vector<std::string> known;
  for (const auto& item : schema.at("properties").items()) known.push_back(item.key());
  for (const MethodInfo* method : all_methods()) {
    for (const auto& parameter : method->parameters) known.push_back(parameter.name);
  }
  for (const auto& item : doc.root().items()) {
    if (std::ranges::count(known, item.key()) == 0)
      throw doc.error("/" + item.key(), "unknown key" + suggestion(item.key(), known));
  }
}

}  // namespace

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  std::error_code ec;
  for (const auto& entry : fs::recursive_directory_iterator(folder(), ec)) {
    if (entry.path().extension() != ".json") continue;
    names.push_back(entry.path().lexically_relative(folder()).replace_extension().generic_string());
  }
  std::ranges::sort(names);
  return names;
}

Json load_preset(const std::string& name) {
  const auto names = preset_names();
  if (std::ranges::count(names, name) == 0)
    throw fail(ErrorKind::config, "no preset '{}'{}", name, suggestion(name, names));
  return read_preset(folder() / (name + ".json"));
}

Json read_preset(const fs::path& file) {
  const JsonDocument doc = JsonDocument::load(file, ErrorKind::config);
  check_schema(doc, preset_schema());
  check_keys(doc, preset_schema());
  Json keys = doc.root();
  keys.erase("description");
  return keys;
}

Json preset_of(const JsonDocument& doc, const Json& object, const std::string& at) {
  if (!object.contains("preset")) return Json::object();
  const Json& name = object.at("preset");
  if (!name.is_string()) throw doc.error(at + "/preset", "must be the name of a preset");
  try {
    return load_preset(name.get<std::string>());
  } catch (const Error& e) {
    throw doc.error(at + "/preset", e.what());
  }
}

}  // namespace vsglbench
