// One list of fields a structure, walked in either direction between C++ and JSON.
//
//   void fields(auto& archive, Is<GitState> auto& v) {
//     archive("commit", v.commit);
//     archive("dirty", v.dirty);
//   }
#pragma once

#include <concepts>
#include <stdexcept>

#include "report/report.h"

namespace vsglbench {

template <class T, class U>
concept Is = std::same_as<std::remove_const_t<T>, U>;

// T, const or not, has a list of fields.
template <class T, class A>
concept Structure = requires(A& archive, T& value) {
  fields(archive, value);
};

// Structures to JSON. An empty optional is left out.
class JsonWriter {
 public:
  Json json = Json::object();

  template <class T>
  void operator()(const char* key, const T& value) {
    json[key] = encode(value);
  }
  template <class T>
  void operator()(const char* key, const std::optional<T>& value) {
    if (value) json[key] = encode(*value);
  }
  template <class T>
  void unless_empty(const char* key, const T& value) {
    if (!value.empty()) json[key] = encode(value);
  }
  template <class T>
  void unless_default(const char* key, const T& value) {
    if (value != T{}) json[key] = encode(value);
  }
  template <class F>
  void object(const char* key, F list) {
    JsonWriter inner;
    list(inner);
    json[key] = std::move(inner.json);
  }
  void constant(const char* key, const char* value) { json[key] = value; }

 private:
  template <class T>
  static Json encode(const T& value);
  template <class T>
  static Json encode(const std::vector<T>& values) {
    Json out = Json::array();
    for (const auto& v : values) out.push_back(encode(v));
    return out;
  }
  static Json encode(const Json& value) { return value; }
  static Json encode(const Interval& v) { return {v.lo, v.hi}; }
  static Json encode(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
  static Json encode(const glm::uvec2& v) { return {v.x, v.y}; }
  static Json encode(const Crop& v) { return {v.x, v.y, v.width, v.height}; }
  static Json encode(const PassId& v) { return v.name(); }
  static Json encode(ErrorKind v) { return std::string(name(v)); }
  static Json encode(Status v) { return std::string(name(v)); }
  static Json encode(StopReason v) { return std::string(name(v)); }
  static Json encode(Measure v) { return std::string(name(v)); }
};

// JSON that obeys the schema to structures.
class JsonReader {
 public:
  explicit JsonReader(const Json& json) : json_(json) {}

  template <class T>
  void operator()(const char* key, T& value) {
    decode(json_.at(key), value);
  }
  template <class T>
  void operator()(const char* key, std::optional<T>& value) {
    if (json_.contains(key)) decode(json_.at(key), value.emplace());
  }
  template <class T>
  void unless_empty(const char* key, T& value) {
    if (json_.contains(key)) decode(json_.at(key), value);
  }
  template <class T>
  void unless_default(const char* key, T& value) {
    if (json_.contains(key)) decode(json_.at(key), value);
  }
  template <class F>
  void object(const char* key, F list) {
    JsonReader inner(json_.at(key));
    list(inner);
  }
  void constant(const char*, const char*) {}  // the schema checks it

 private:
  template <class T>
  static void decode(const Json& json, T& value);
  template <class T>
  static void decode(const Json& json, std::vector<T>& values) {
    values.clear();
    for (const auto& item : json) decode(item, values.emplace_back());
  }
  static void decode(const Json& json, Json& value) { value = json; }
  static void decode(const Json& j, Interval& v) { v = {j.at(0).get<double>(), j.at(1).get<double>()}; }
  static void decode(const Json& j, glm::dvec3& v) {
    v = {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
  }
  static void decode(const Json& j, glm::uvec2& v) { v = {j.at(0).get<uint32_t>(), j.at(1).get<uint32_t>()}; }
  static void decode(const Json& j, Crop& v) {
    v = {j.at(0).get<uint32_t>(), j.at(1).get<uint32_t>(), j.at(2).get<uint32_t>(), j.at(3).get<uint32_t>()};
  }
  static void decode(const Json& j, PassId& v) { v = parse_pass_name(j.get<std::string>()); }
  static void decode(const Json& j, ErrorKind& v) { v = error_kind(j.get<std::string>()).value(); }
  static void decode(const Json& j, Status& v) { v = pick(j, {Status::ok, Status::failed, Status::skipped}); }
  static void decode(const Json& j, Measure& v) { v = pick(j, {Measure::frame, Measure::generation}); }
  static void decode(const Json& j, StopReason& v) {
    v = pick(j, {StopReason::converged, StopReason::time_limit, StopReason::max_samples});
  }
  template <class E>
  static E pick(const Json& json, std::initializer_list<E> values) {
    for (const E v : values) {
      if (json.get<std::string>() == name(v)) return v;
    }
    throw std::invalid_argument(json.get<std::string>());
  }

  const Json& json_;
};

template <class T>
Json JsonWriter::encode(const T& value) {
  if constexpr (Structure<const T, JsonWriter>) {
    JsonWriter inner;
    fields(inner, value);
    return std::move(inner.json);
  } else {
    return Json(value);
  }
}

template <class T>
void JsonReader::decode(const Json& json, T& value) {
  if constexpr (Structure<T, JsonReader>) {
    JsonReader inner(json);
    fields(inner, value);
  } else {
    value = json.get<T>();
  }
}

}  // namespace vsglbench
