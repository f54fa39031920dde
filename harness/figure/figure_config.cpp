#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/file.h"
#include "base/nearest.h"
#include "figure/figure.h"
#include "method/registry.h"
#include "scene/scene_file.h"

namespace vsglbench {
namespace {

Json figure_schema(const std::string& name) {
  const auto path = data_root() / "harness" / "figure" / "figure.schema.json";
  return JsonDocument::load(path, ErrorKind::config).root().at("$defs").at(name);
}

const std::string& figure_name(const JsonDocument& document) {
  if (!document.root().is_object() || !document.root().contains("figure")) {
    throw document.error(
        "", "describes no figure: it has no key \"figure\"; run experiments with `vsglbench run`");
  }
  const Json& figure = document.root()["figure"];
  const auto& names = figure_names();
  if (!figure.is_string() || std::ranges::count(names, figure.get<std::string>()) == 0) {
    throw document.error("/figure",
                         fmt::format("names no figure: {}{}", figure.dump(),
                                     figure.is_string() ? suggestion(figure.get<std::string>(), names) : ""));
  }
  return figure.get_ref<const std::string&>();
}

// A scene that is named is checked with its view; what a path leads to shows when it is loaded.
void check_scene_name(const JsonDocument& document) {
  const std::string scene = document.root().at("scene");
  const auto [name, chosen] = parse_scene_name(scene);
  if (is_path(name)) {
    std::error_code ec;
    if (!std::filesystem::exists(name, ec))
      throw document.error("/scene", fmt::format("no scene '{0}': {0} does not exist", name));
    return;
  }
  std::vector<std::string> names;
  for (const SceneInfo& info : list_scenes({data_root() / "scenes", {}})) {
    names.push_back(info.name);
    if (info.name != name) continue;
    const std::string view = chosen.value_or(info.default_view);
    if (std::ranges::count(info.views, view) > 0) return;
    throw document.error("/scene",
                         fmt::format("{} has no view '{}'{}", name, view, suggestion(view, info.views)));
  }
  throw document.error("/scene", fmt::format("no scene '{}'{}", name, suggestion(name, names)));
}

const MethodInfo& method_of(const JsonDocument& document) {
  try {
    const MethodInfo& method = find_method(document.root().at("method"));
    if (method.refused.empty()) return method;
    throw Error(ErrorKind::plugin, method.refused);
  } catch (const Error& e) {
    throw document.error("/method", e.what());
  }
}

// N where the method reads one, and only there.
void check_light_count(const JsonDocument& document, const MethodInfo& method) {
  const Json& root = document.root();
  if (!method.takes_light_count && root.contains("N")) {
    const std::string makes =
        method.light_count > 0 ? fmt::format("{} lights", method.light_count) : "a light of every texel";
    throw document.error("/N", fmt::format("is not read: {} makes {}", method.name, makes));
  }
  if (!method.takes_light_count) return;
  if (!root.contains("N")) throw document.error("", fmt::format("lacks 'N', the lights of {}", method.name));
  const uint64_t rsm = root.at("rsm"), lights = root.at("N");
  if (lights > rsm * rsm) {
    throw document.error("/N",
                         fmt::format("{} lights can't be drawn from an RSM of {} texels", lights, rsm * rsm));
  }
}

void check_method(const JsonDocument& document) {
  const MethodInfo& method = method_of(document);
  Json parameters;
  try {
    parameters = resolve_parameters(method, document.root().value("parameters", Json::object()));
  } catch (const Error& e) {
    throw document.error("/parameters", e.what());
  }
  check_light_count(document, method);
  if (method.makes_vpls.is_null()) return;
  const auto& when = method.makes_vpls.items();
  if (std::all_of(when.begin(), when.end(), [&](const auto& item) {
        return parameters.contains(item.key()) && parameters.at(item.key()) == item.value();
      })) {
    throw document.error("/method",
                         method.name + " makes no VSGLs; use a method that does, such as two-vsgl");
  }
}

// `key`: "width" or "height"; the schema's limits of it hold for the option as they do for the config.
void replace_size(const Json& schema, const std::string& key, uint32_t size, Json* config) {
  if (size == 0) return;
  const std::string name = config->at("figure");
  const Json& limits = schema.at("properties").at(key);
  const auto least = limits.at("minimum").get<uint32_t>(), most = limits.at("maximum").get<uint32_t>();
  if (size > most) {
    throw fail(ErrorKind::usage, "--{} {} is too large for {}; make it at most {}", key, size, name, most);
  }
  if (size < least) {
    throw fail(ErrorKind::usage, "--{} {} is too small for {}; make it at least {}", key, size, name, least);
  }
  (*config)[key] = size;
}

}  // namespace

Json load_figure_config(const std::filesystem::path& path, uint32_t width, uint32_t height) {
  const JsonDocument document = JsonDocument::load(path, ErrorKind::config);
  const std::string& name = figure_name(document);
  const Json schema = figure_schema(name);
  check_schema(document, schema);
  Json config = document.root();
  if (config.contains("least") && config["least"].get<double>() >= config["most"].get<double>()) {
    throw document.error(
        "/least", fmt::format("{} is not under 'most', {}", config["least"].dump(), config["most"].dump()));
  }
  if (config.contains("scene")) check_scene_name(document);
  if (config.contains("method")) check_method(document);
  replace_size(schema, "width", width, &config);
  replace_size(schema, "height", height, &config);
  return config;
}

}  // namespace vsglbench
