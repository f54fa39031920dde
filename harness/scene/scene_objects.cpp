#include "scene/scene_objects.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "scene/animation.h"
#include "scene/scene_keys.h"
#include "scene/shapes.h"

namespace vsglbench {
namespace {

const Json& value(const JsonDocument& document, const std::string& at) {
  return document.root().at(Json::json_pointer(at));
}

glm::dvec3 vector(const Json& v) { return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()}; }

glm::dquat quaternion(const JsonDocument& document, const std::string& at) {
  const Json& v = value(document, at);
  const glm::dquat q(v[3].get<double>(), v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
  const double largest = std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z), std::abs(q.w)});
  if (!(largest > 0 && std::isfinite(largest))) throw document.error(at, "has no length");
  const bool squares_keep_digits = largest > 1e-100 && largest < 1e100;
  return squares_keep_digits ? q : glm::dquat(q.w / largest, q.x / largest, q.y / largest, q.z / largest);
}

MovingNode read_node(const JsonDocument& document, const std::string& at) {
  const Json& json = value(document, at);
  const KeyList keys(document, at);
  const auto read_vector = [&](const std::string& p) { return vector(value(document, p)); };
  const auto read_scale = [&](const std::string& p) {
    const Json& v = value(document, p);
    return v.is_number() ? glm::dvec3(v.get<double>()) : vector(v);
  };
  const auto read_rotation = [&](const std::string& p) { return quaternion(document, p); };
  const auto constant = [&](const char* key, auto standard, const auto& read) {
    return json.contains(key) ? read(at + "/" + key) : standard;
  };
  MovingNode node;
  node.name = json.at("name").get<std::string>();
  node.translation =
      keys.track("translation", constant("translation", glm::dvec3(0), read_vector), read_vector);
  node.rotation =
      keys.track("rotation", constant("rotation", glm::dquat(1, 0, 0, 0), read_rotation), read_rotation);
  node.scale = keys.track("scale", constant("scale", glm::dvec3(1), read_scale), read_scale);
  return node;
}

Material read_material(const Json& json, const std::string& name) {
  Material m;
  m.name = "object " + name;
  if (json.contains("base_color")) m.base_color = glm::vec4(glm::vec3(vector(json["base_color"])), 1);
  m.metallic = json.value("metallic", m.metallic);
  m.roughness = json.value("roughness", m.roughness);
  m.phong_exponent = json.value("phong_exponent", m.phong_exponent);
  m.specular = json.value("specular", m.specular);
  return m;
}

Mesh read_torus(const JsonDocument& document, const std::string& at) {
  const Json& json = value(document, at);
  const double major = json.at("major").get<double>(), minor = json.at("minor").get<double>();
  if (!(minor < major))
    throw document.error(at + "/minor", fmt::format("must be less than 'major', {}", major));
  Mesh mesh;
  add_torus(&mesh, major, minor, json.value("segments", 64), json.value("sides", 16));
  return mesh;
}

Mesh read_quad(const JsonDocument& document, const std::string& at) {
  const Json& json = value(document, at);
  const glm::dvec3 u = vector(json.at("u")), v = vector(json.at("v"));
  const double tile = std::max(glm::length(u), glm::length(v));
  if (!(glm::length(glm::cross(u, v)) > 1e-9 * tile * tile))
    throw document.error(at, "has no area: 'u' and 'v' are in line, or have no length");
  Mesh mesh;
  add_grid(&mesh, vector(json.at("corner")), u, v, 1, 1, tile);
  return mesh;
}

Mesh read_shape(const JsonDocument& document, const std::string& at) {
  const Json& json = value(document, at);
  if (json.contains("torus") == json.contains("quad"))
    throw document.error(at, "must have one shape, either 'torus' or 'quad'");
  return json.contains("torus") ? read_torus(document, at + "/torus") : read_quad(document, at + "/quad");
}

}  // namespace

void check_objects(SceneProblems* problems) {
  const JsonDocument& document = problems->document();
  if (!document.root().is_object() || !document.root().value("objects", Json()).is_array()) return;
  for (size_t i = 0; i < document.root().at("objects").size(); ++i) {
    const std::string object = fmt::format("/objects/{}", i);
    problems->check(object, [&](const std::string& at) { read_node(document, at); });
    problems->check(object, [&](const std::string& at) { read_shape(document, at); });
  }
}

void add_objects(const JsonDocument& document, double unit, Scene* scene) {
  const Json list = document.root().value("objects", Json::array());
  std::set<std::string> names;
  for (size_t i = 0; i < list.size(); ++i) {
    const std::string at = fmt::format("/objects/{}", i), name = list[i].at("name").get<std::string>();
    if (!names.insert(name).second) throw document.error(at + "/name", "stands twice");
    MovingNode node = read_node(document, at);
    Mesh mesh = read_shape(document, at);
    scene->materials.push_back(read_material(list[i].value("material", Json::object()), name));
    scene->animation.nodes.push_back(std::move(node));
    add_object(scene,
               {.name = name, .node = static_cast<uint32_t>(scene->animation.nodes.size() - 1), .unit = unit},
               std::move(mesh), static_cast<uint32_t>(scene->materials.size() - 1));
  }
  try {
    if (!list.empty()) measure_motion(scene);
  } catch (const Error& e) {
    throw document.error("/objects", e.what());
  }
}

}  // namespace vsglbench
