#include <algorithm>

#include "base/error.h"
#include "base/json_number.h"
#include "base/nearest.h"
#include "method/method.h"

namespace vsglbench {
namespace {

void check(const MethodInfo& method, const ParameterInfo& parameter, const Json& value) {
  const auto wrong = [&](const std::string& why) {
    return fail(ErrorKind::config, "{}: parameter '{}' {}", method.name, parameter.name, why);
  };
  if (parameter.default_value.is_string()) {
    if (!value.is_string()) throw wrong(fmt::format("is {} but must be a string", value.dump()));
    const auto text = value.get<std::string>();
    for (const auto& choice : parameter.choices) {
      if (choice == text) return;
    }
    throw wrong(fmt::format("is '{}'{}", text, suggestion(text, parameter.choices)));
  }
  const bool integer = parameter.default_value.is_number_integer();
  if (!(integer ? is_whole(value) : value.is_number())) {
    throw wrong(fmt::format("is {} but must be {}", value.dump(), integer ? "an integer" : "a number"));
  }
  const double number = value.get<double>();
  if (!(number >= parameter.minimum && number <= parameter.maximum)) {
    throw wrong(
        fmt::format("is {} but must be within {} … {}", number, parameter.minimum, parameter.maximum));
  }
}

}  // namespace

Json resolve_parameters(const MethodInfo& method, const Json& given) {
  std::vector<std::string> known;
  for (const auto& parameter : method.parameters) known.push_back(parameter.name);
  for (const auto& [key, value] : given.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw fail(ErrorKind::config, "{} has no parameter '{}'{}", method.name, key, suggestion(key, known));
    }
  }
  Json resolved = Json::object();
  for (const auto& parameter : method.parameters) {
    const Json value = given.contains(parameter.name) ? given.at(parameter.name) : parameter.default_value;
    check(method, parameter, value);
    // 16.0 is the integer 16 of a parameter that is one, and stays what it is of one that isn't.
    resolved[parameter.name] = parameter.default_value.is_number_integer() ? with_integers(value) : value;
  }
  return resolved;
}

}  // namespace vsglbench
