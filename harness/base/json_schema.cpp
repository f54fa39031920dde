// The part of JSON Schema that this project's schemas use.
#include "base/json.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "base/json_number.h"
#include "base/json_violations.h"
#include "base/nearest.h"
#include "base/pattern.h"
#include "base/printable.h"

namespace vsglbench {
namespace {

using Violation = std::function<void(const std::string& pointer, const std::string& message)>;

// A value as a message shows it.
std::string shown(const Json& v) {
  if (v.is_object() || v.is_array()) return v.type_name();
  return excerpt(v.dump(-1, ' ', false, Json::error_handler_t::replace));
}

bool has_type(const Json& v, const std::string& type) {
  if (type == "object") return v.is_object();
  if (type == "array") return v.is_array();
  if (type == "string") return v.is_string();
  if (type == "number") return v.is_number();
  if (type == "integer") return is_whole(v);
  if (type == "boolean") return v.is_boolean();
  if (type == "null") return v.is_null();
  throw std::logic_error("schema: unknown type " + type);
}

// The member of this name, or an empty object.
const Json& member(const Json& schema, const char* name) {
  static const Json none = Json::object();
  const auto it = schema.find(name);
  return it == schema.end() ? none : *it;
}

// Made once: that takes longer than most searches.
const Pattern& compiled(const std::string& pattern) {
  thread_local std::map<std::string, Pattern> known;
  const auto it = known.find(pattern);
  return it != known.end() ? it->second : known.emplace(pattern, Pattern(pattern)).first->second;
}

size_t characters(const std::string& text) {
  return static_cast<size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

class SchemaChecker {
 public:
  SchemaChecker(const Json& root, Violation report) : root_(root), report_(std::move(report)) {}

  void check(const Json& v, const Json& schema, const std::string& at) {
    if (schema.is_boolean()) {
      if (!schema.get<bool>()) report_(at, "is not allowed here");
      return;
    }
    for (const auto& [keyword, rule] : schema.items()) {
      if (keyword == "$ref") {
        const std::string ref = rule.get<std::string>();
        check(v, root_.at(Json::json_pointer(ref.substr(1))), at);
      } else if (keyword == "type") {
        check_type(v, rule, at);
      } else if (keyword == "enum" || keyword == "const") {
        check_enum(v, keyword == "const" ? Json::array({rule}) : rule, at);
      } else if (keyword == "oneOf" || keyword == "anyOf") {
        check_alternatives(v, rule, at);
      } else if (v.is_object() && keyword == "required") {
        for (const auto& k : rule) check_required(v, schema, k.get<std::string>(), at);
      } else if (v.is_object() && keyword == "propertyNames") {
        for (const auto& [name, unused] : v.items()) check(Json(name), rule, at + "/" + pointer_token(name));
      } else if (v.is_number() && is_bound(keyword)) {
        check_bound(v.get<double>(), keyword, rule.get<double>(), at);
      } else if (keyword == "minItems" || keyword == "minProperties" || keyword == "maxItems") {
        check_count(v, keyword, rule.get<size_t>(), at);
      } else if (v.is_string() && keyword == "maxLength") {
        if (const size_t n = characters(v.get_ref<const std::string&>()), most = rule.get<size_t>(); n > most)
          report_(at, fmt::format("has {} characters but may have {}", n, most));
      } else if (v.is_string() && keyword == "minLength") {
        if (v.get<std::string>().size() < rule.get<size_t>()) report_(at, "is empty or too short");
      } else if (v.is_string() && keyword == "pattern") {
        check_pattern(v.get<std::string>(), rule.get<std::string>(), at);
      } else if (v.is_array() && keyword == "items") {
        for (size_t i = 0; i < v.size(); ++i) check(v[i], rule, fmt::format("{}/{}", at, i));
      } else if (!is_known(keyword)) {
        throw std::logic_error("schema: unsupported keyword " + keyword);
      }
    }
    if (v.is_object()) check_properties(v, schema, at);
  }

 private:
  static bool is_bound(const std::string& k) {
    return k == "minimum" || k == "maximum" || k == "exclusiveMinimum" || k == "exclusiveMaximum";
  }
  static bool is_known(const std::string& k) {
    static const std::set<std::string> known = {"$schema",
                                                "$id",
                                                "$defs",
                                                "title",
                                                "description",
                                                "default",
                                                "examples",
                                                "required",
                                                "minimum",
                                                "maximum",
                                                "exclusiveMinimum",
                                                "exclusiveMaximum",
                                                "minLength",
                                                "maxLength",
                                                "pattern",
                                                "items",
                                                "properties",
                                                "propertyNames",
                                                "additionalProperties"};
    return known.count(k) > 0;
  }
  static bool is_of_type(const Json& v, const Json& schema) {
    const Json& type = member(schema, "type");
    return type.is_string() && has_type(v, type.get<std::string>());
  }
  void check_type(const Json& v, const Json& rule, const std::string& at) {
    const Json types = rule.is_array() ? rule : Json::array({rule});
    for (const auto& t : types) {
      if (has_type(v, t.get<std::string>())) return;
    }
    std::string wanted;
    for (const auto& t : types) wanted += (wanted.empty() ? "" : " or ") + t.get<std::string>();
    report_(at, fmt::format("is {} but must be {}", shown(v), wanted));
  }
  // What lacks a key often has it misspelt.
  void check_required(const Json& v, const Json& schema, const std::string& wanted, const std::string& at) {
    if (v.contains(wanted)) return;
    const Json& properties = member(schema, "properties");
    for (const auto& [key, unused] : v.items()) {
      if (properties.contains(key) || edit_distance(key, wanted) > std::max<size_t>(2, key.size() / 2))
        continue;
      return report_(at + "/" + pointer_token(key),
                     fmt::format("unknown key '{}'; did you mean '{}'?", excerpt(key), wanted));
    }
    report_(at, fmt::format("lacks '{}'", wanted));
  }
  void check_enum(const Json& v, const Json& allowed, const std::string& at) {
    std::vector<std::string> names;
    for (const auto& a : allowed) {
      if (a == v) return;
      names.push_back(a.is_string() ? a.get<std::string>() : a.dump());
    }
    const std::string got = v.is_string() ? v.get<std::string>() : shown(v);
    report_(at, fmt::format("'{}' is not allowed{}", excerpt(got), suggestion(got, names)));
  }
  void check_alternatives(const Json& v, const Json& alternatives, const std::string& at) {
    std::vector<std::pair<std::string, std::string>> best;
    std::pair<size_t, bool> most;
    bool first = true;
    for (const auto& alternative : alternatives) {
      std::vector<std::pair<std::string, std::string>> found;
      SchemaChecker inner(root_,
                          [&](const std::string& p, const std::string& m) { found.emplace_back(p, m); });
      inner.check(v, alternative, at);
      if (found.empty()) return;
      // The alternative that fails deepest is the one that was meant; of those, one of the value's type.
      const std::pair rank(found.front().first.size(), is_of_type(v, alternative));
      if (first || rank > most) best = found, most = rank;
      first = false;
    }
    for (const auto& [p, m] : best) report_(p, m);
  }
  void check_pattern(const std::string& text, const std::string& pattern, const std::string& at) {
    if (!compiled(pattern).search(text))
      report_(at, fmt::format("'{}' does not match {}", excerpt(text), excerpt(pattern)));
  }
  void check_bound(double v, const std::string& keyword, double bound, const std::string& at) {
    if (keyword == "minimum" && !(v >= bound)) report_(at, fmt::format("{} must be at least {}", v, bound));
    if (keyword == "maximum" && !(v <= bound)) report_(at, fmt::format("{} must be at most {}", v, bound));
    if (keyword == "exclusiveMinimum" && !(v > bound))
      report_(at, fmt::format("{} must be over {}", v, bound));
    if (keyword == "exclusiveMaximum" && !(v < bound))
      report_(at, fmt::format("{} must be under {}", v, bound));
  }
  void check_count(const Json& v, const std::string& keyword, size_t n, const std::string& at) {
    if (keyword == "minItems" && v.is_array() && v.size() < n) {
      report_(at, v.empty() ? fmt::format("is an empty list; give at least {}", n)
                            : fmt::format("has {} items but needs {}", v.size(), n));
    }
    if (keyword == "maxItems" && v.is_array() && v.size() > n) {
      report_(at, fmt::format("has {} items but may have {}", v.size(), n));
    }
    if (keyword == "minProperties" && v.is_object() && v.size() < n) {
      report_(at, fmt::format("has {} keys but needs {}", v.size(), n));
    }
  }
  void check_properties(const Json& v, const Json& schema, const std::string& at) {
    const Json& properties = member(schema, "properties");
    for (const auto& [key, value] : v.items()) {
      const std::string child = at + "/" + pointer_token(key);
      if (properties.contains(key)) {
        check(value, properties.at(key), child);
      } else if (schema.contains("additionalProperties")) {
        const Json& rule = schema.at("additionalProperties");
        if (rule.is_boolean() && !rule.get<bool>()) {
          std::vector<std::string> known;
          for (const auto& [k, unused] : properties.items()) known.push_back(k);
          report_(child, fmt::format("unknown key '{}'{}", excerpt(key), suggestion(key, known)));
        } else {
          check(value, rule, child);
        }
      }
    }
  }

  const Json& root_;
  Violation report_;
};

}  // namespace

void check_schema(const JsonDocument& doc, const Json& schema) {
  SchemaChecker(schema, [&](const std::string& at, const std::string& message) {
    throw doc.error(at, message);
  }).check(doc.root(), schema, "");
}

std::vector<SchemaViolation> all_violations(const JsonDocument& doc, const Json& schema) {
  std::vector<SchemaViolation> out;
  SchemaChecker(schema, [&](const std::string& at, const std::string& message) {
    out.push_back({at, message});
  }).check(doc.root(), schema, "");
  return out;
}

std::vector<std::string> schema_violations(const Json& value, const Json& schema) {
  std::vector<std::string> out;
  SchemaChecker(schema, [&](const std::string& at, const std::string& message) {
    out.push_back(fmt::format("{}: {}", at.empty() ? "/" : at, message));
  }).check(value, schema, "");
  return out;
}

}  // namespace vsglbench
