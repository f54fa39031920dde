#include "run/case_key_docs.h"

#include <fmt/ranges.h>

namespace vsglbench {
namespace {

std::string text_of(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

}  // namespace

std::string readers_of(const CaseKey& key) {
  std::vector<std::string> readers;
  if (key.scope & kMethodTakesCount) readers.push_back("methods that take a number of lights");
  if (key.scope & kMethodTakesPdf) readers.push_back("methods that draw lights");
  if (key.scope & kFrame) readers.push_back("shaded frames");
  if (key.scope & kGeneration) readers.push_back("generation alone");
  if (key.scope & kVsgl) readers.push_back("VSGLs");
  return readers.empty() ? "every case" : fmt::format("{}", fmt::join(readers, ", "));
}

Json list_case_keys() {
  Json out = Json::array();
  for (const CaseKey& key : case_keys()) {
    out.push_back({{"name", key.name},
                   {"summary", key.help},
                   {"default", key.default_value},
                   {"values", key.values},
                   {"read_by", readers_of(key)}});
  }
  return out;
}

std::string keys_as_markdown() {
  std::string out;
  for (const CaseKey& key : case_keys()) {
    out += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, key.values, text_of(key.default_value),
                       readers_of(key), key.help);
  }
  return out;
}

std::string keys_as_schema() {
  std::string out;
  for (const CaseKey& key : case_keys()) {
    const Json list = {{"type", "array"}, {"minItems", 1}, {"items", key.schema}};
    const Json rule = {{"description", key.help},
                       {"default", key.default_value},
                       {"oneOf", Json::array({key.schema, list})}};
    out += fmt::format("    \"{}\": {},\n", key.name, rule.dump());
  }
  return out;
}

}  // namespace vsglbench
