#include "run/overrides.h"

#include <algorithm>

#include "base/error.h"
#include "base/nearest.h"
#include "run/method_keys.h"

namespace vsglbench {
namespace {

// Numbers, lists and quoted text are JSON; all else is text. No key takes more than a list, and what is
// nested deeper is dropped before it can be walked.
Json value_of(const std::string& text) {
  const auto shallow = [](int depth, Json::parse_event_t, Json&) { return depth < 4; };
  const Json value = Json::parse(text, shallow, false);
  return value.is_discarded() ? Json(text) : value;
}

// A setting as messages repeat it.
std::string shown(const std::string& setting) {
  constexpr size_t kMost = 100;
  if (setting.size() <= kMost) return setting;
  size_t end = kMost;
  while (end > 0 && (static_cast<unsigned char>(setting[end]) & 0xC0) == 0x80) --end;  // no character is cut
  return setting.substr(0, end) + "…";
}

void check(const CaseKey& key, const Json& value, const std::string& setting) {
  if (value.is_array() && value.empty())
    throw fail(ErrorKind::config, "--set {}: is an empty list: it would make no case", shown(setting));
  FrameParameters unused;
  for (const Json& each : value.is_array() ? value : Json::array({value})) {
    try {
      key.read(each, &unused);
      if (key.look_up) key.look_up(unused);
    } catch (const Error& e) {
      throw fail(ErrorKind::config, "--set {}: {}", shown(setting), shown(e.what()));
    }
  }
}

// Whether the method has a parameter of its own under this name, which is not what --set sets.
bool has_own(const Json& method, const std::string& key) {
  const auto& all = all_methods();
  const auto at = std::ranges::find_if(all, [&](const MethodInfo* m) { return method == m->name; });
  return at != all.end() && MethodKeys{**at, true}.is_own(key);
}

}  // namespace

Overrides parse_overrides(const std::vector<std::string>& settings) {
  Overrides out = Json::object();
  for (const std::string& setting : settings) {
    const size_t equals = setting.find('=');
    if (equals == std::string::npos)
      throw fail(ErrorKind::config, "--set takes KEY=VALUE, such as N=64, not '{}'", shown(setting));
    const std::string name = setting.substr(0, equals);
    const CaseKey* key = find_case_key(name);
    if (!key)
      throw fail(ErrorKind::config, "--set {}: unknown key '{}'{}", shown(setting), shown(name),
                 suggestion(name, case_key_names()));
    if (out.contains(name))
      throw fail(ErrorKind::config, "--set {}: '{}' is set twice", shown(setting), name);
    out[name] = value_of(setting.substr(equals + 1));
    check(*key, out[name], setting);
  }
  return out;
}

void apply(const Overrides& overrides, Json* root) {
  for (const auto& [name, value] : overrides.items()) {
    const unsigned scope = find_case_key(name)->scope;
    const bool frames = root->value("measure", "frame") == "frame";
    if ((scope & kFrame) && !frames)
      throw fail(ErrorKind::config, "--set {}: is not read where only generation is measured", name);
    if ((scope & kGeneration) && frames)
      throw fail(ErrorKind::config, "--set {}: {}", name, unread_in_frames(name));
    (*root)[name] = value;
    for (Json& entry : root->at("methods")) {
      if (!has_own(entry.at("method"), name)) entry.erase(name);
    }
  }
}

void check_read(const Overrides& overrides, const std::vector<Case>& cases) {
  for (const auto& [name, value] : overrides.items()) {
    const auto reads = [&, &key = name](const Case& c) {
      return c.parameters.contains(key) && !has_own(c.method, key);
    };
    if (std::ranges::none_of(cases, reads))
      throw fail(ErrorKind::config, "--set {}: no case of this config reads it", name);
  }
}

}  // namespace vsglbench
