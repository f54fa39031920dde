// JSON with the line of every value, so that an error can say file:line.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace vsglbench {

using Json = nlohmann::ordered_json;

// A parsed file, and where each of its values stands. Lines are looked up in its text when one is asked for:
// a report has millions of values, and next to none of them is ever wrong.
class JsonDocument {
 public:
  // Throws Error(kind): "PATH:LINE: not JSON: REASON" (also for a key given twice), or the read error.
  static JsonDocument load(const std::filesystem::path& path, ErrorKind kind);
  static JsonDocument parse(std::string_view text, std::string name, ErrorKind kind);

  const Json& root() const { return root_; }
  const std::string& name() const { return name_; }

  // Line (from 1) of the value at a JSON pointer such as "/light/fov"; of its nearest known parent else.
  int line(std::string pointer) const;

  // The same file with a patch applied (JSON Merge Patch, RFC 7386): a value of the patch has the line of its
  // nearest parent that the file has.
  JsonDocument patched(const Json& patch) const;

  // Error(kind) "NAME:LINE: MESSAGE" for the value at `pointer`.
  Error error(const std::string& pointer, const std::string& message) const;

 private:
  static JsonDocument of(std::string text, std::string name, ErrorKind kind);

  Json root_;
  std::string name_, text_;
  ErrorKind kind_ = ErrorKind::config;
  mutable std::map<std::string, int> lines_;  // by pointer; empty until one is asked for
};

// Checks `value` (at `pointer` of `doc`) against a JSON Schema. Supported keywords: type, enum, const,
// properties, propertyNames, required, additionalProperties (bool or schema), items, minItems, maxItems,
// minProperties, minimum, maximum, exclusiveMinimum, exclusiveMaximum, minLength, maxLength, pattern, oneOf,
// anyOf, $ref "#/$defs/x". An unsupported keyword in the schema itself throws std::logic_error. Throws
// doc.error() for the first violation; an unknown key names the nearest known one.
void check_schema(const JsonDocument& doc, const Json& schema);

// All violations as "POINTER: MESSAGE", for values that have no file (a report about to be written).
std::vector<std::string> schema_violations(const Json& value, const Json& schema);

// Escapes a key for use in a JSON pointer.
std::string pointer_token(std::string_view key);

}  // namespace vsglbench
