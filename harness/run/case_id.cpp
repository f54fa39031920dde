#include "run/case_id.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/json_number.h"

namespace vsglbench {
namespace {

std::string canonical(const Json& value) {
  return value.is_number() ? fmt::format("{}", value.get<double>()) : value.dump();
}

// "vis=exact": short, since it becomes part of a file's name. Of an integer 16.0 is 16; other numbers keep
// the spelling that the config gives them.
std::string text_of(const Setting& s, const Json& parameters) {
  const auto resolved = parameters.find(s.key);
  const Json value =
      resolved != parameters.end() && resolved->is_number_integer() ? with_integers(s.value) : s.value;
  std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  std::ranges::replace(text, '/', '-');  // that of "papers/mfis16"
  return fmt::format("{}={}", s.label, text);
}

// The values of each parameter, by method and key.
using Values = std::map<std::pair<std::string, std::string>, std::set<std::string>>;

Values values_of(const std::vector<NamedCase>& cases) {
  Values values;
  for (const NamedCase& n : cases) {
    for (const auto& [key, value] : n.c.parameters.items())
      values[{n.c.method, key}].insert(canonical(value));
  }
  return values;
}

}  // namespace

void name_cases(std::vector<NamedCase>* cases) {
  const Values values = values_of(*cases);
  for (NamedCase& n : *cases) {
    std::string names;
    for (const Setting& s : n.settings) {
      const auto all = values.find({n.c.method, s.key});
      if (!s.named && (all == values.end() || all->second.size() < 2)) continue;
      names += (names.empty() ? "" : ",") + text_of(s, n.c.parameters);
    }
    n.c.id = n.c.method + "/" + names;
  }
}

std::string fingerprint(const Case& c) {
  std::string out = c.method;
  for (const auto& [key, value] : c.parameters.items()) out += fmt::format("\n{}={}", key, canonical(value));
  return out;
}

}  // namespace vsglbench
