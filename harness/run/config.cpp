#include "run/config.h"

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "base/nearest.h"

namespace vsglbench {
namespace {

// The keys of a method entry that every case has, beside the method's own parameters.
const std::vector<std::string> kCaseKeys = {"N", "rsm", "importance_lights", "visibility"};

// A value or a list of values: the list.
Json as_list(const Json& value) { return value.is_array() ? value : Json::array({value}); }

std::string value_text(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

// What one method entry sweeps, key by key, after the config's own lists.
using Axes = std::vector<std::pair<std::string, Json>>;

Axes axes_of(const JsonDocument& doc, const Json& entry, const std::string& at, const MethodInfo& method) {
  const Json& root = doc.root();
  const Json defaults = {{"N", 256}, {"rsm", 256}, {"importance_lights", 2048}, {"visibility", "exact"}};
  Axes axes;
  for (const auto& key : kCaseKeys) {
    if (key == "N" && !method.takes_light_count) {
      if (entry.contains(key)) throw doc.error(at + "/N", fmt::format("is not read: {} makes a light of every texel", method.name));
      continue;
    }
    const Json& value = entry.contains(key) ? entry.at(key) : root.contains(key) ? root.at(key) : defaults.at(key);
    axes.emplace_back(key, as_list(value));
  }
  for (const auto& parameter : method.parameters) {
    if (entry.contains(parameter.name)) axes.emplace_back(parameter.name, as_list(entry.at(parameter.name)));
  }
  return axes;
}

void check_entry(const JsonDocument& doc, const Json& entry, const std::string& at, const MethodInfo& method) {
  std::vector<std::string> known = kCaseKeys;
  known.push_back("method");
  for (const auto& parameter : method.parameters) known.push_back(parameter.name);
  for (const auto& [key, value] : entry.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw doc.error(at + "/" + pointer_token(key),
                      fmt::format("unknown key '{}' for {}{}", key, method.name, suggestion(key, known)));
    }
  }
}

uint32_t count_value(const JsonDocument& doc, const std::string& at, const std::string& key, const Json& value,
                     int64_t minimum) {
  if (!value.is_number_integer() || value.get<int64_t>() < minimum || value.get<int64_t>() > (1 << 30)) {
    throw doc.error(at + "/" + key, fmt::format("{} must be an integer of at least {}", value.dump(), minimum));
  }
  return value.get<uint32_t>();
}

class Sweep {
 public:
  Sweep(const JsonDocument& doc, const FrameParameters& base) : doc_(doc), base_(base) {}

  // Every combination of `axes` for one scene and method, in the order of the lists.
  void expand(const std::string& scene, const MethodInfo& method, const Axes& axes, const std::string& at,
              std::vector<Case>* out) {
    std::vector<size_t> index(axes.size(), 0);
    for (;;) {
      Json point = Json::object();
      for (size_t i = 0; i < axes.size(); ++i) point[axes[i].first] = axes[i].second.at(index[i]);
      out->push_back(make_case(scene, method, point, at));
      size_t i = axes.size();
      while (i > 0 && ++index[i - 1] == axes[i - 1].second.size()) index[--i] = 0;
      if (i == 0) return;
    }
  }

 private:
  Case make_case(const std::string& scene, const MethodInfo& method, const Json& point, const std::string& at) {
    Case c;
    c.scene = scene;
    c.method = method.name;
    c.frame = base_;
    Json own = Json::object();
    std::string name;
    const auto append = [&](const std::string& text) { name += (name.empty() ? "" : ",") + text; };
    for (const auto& [key, value] : point.items()) {
      if (key == "N") {
        c.frame.lights = count_value(doc_, at, key, value, 0);
        append(fmt::format("N={}", c.frame.lights));
      } else if (key == "rsm") {
        c.frame.rsm = count_value(doc_, at, key, value, 1);
        append(fmt::format("rsm={}", c.frame.rsm));
      } else if (key == "importance_lights") {
        c.frame.importance_lights = count_value(doc_, at, key, value, 1);
      } else if (key == "visibility") {
        c.frame.visibility = visibility(value, at);
        append(fmt::format("vis={}", visibility_name(c.frame.visibility)));
      } else {
        own[key] = value;
        append(fmt::format("{}={}", key, value_text(value)));
      }
    }
    try {
      c.method_parameters = resolve_parameters(method, own);
    } catch (const Error& e) {
      throw doc_.error(at, e.what());
    }
    c.id = fmt::format("{}/{}/{}", scene, method.name, name);
    c.parameters = resolved(c, method);
    return c;
  }

  Visibility visibility(const Json& value, const std::string& at) {
    if (!value.is_string()) throw doc_.error(at + "/visibility", "must be exact, ism or none");
    try {
      return parse_visibility(value.get<std::string>());
    } catch (const Error& e) {
      throw doc_.error(at + "/visibility", e.what());
    }
  }

  static Json resolved(const Case& c, const MethodInfo& method) {
    Json p = Json::object();
    if (method.takes_light_count) p["N"] = c.frame.lights;
    p["rsm"] = c.frame.rsm;
    p["width"] = c.frame.width;
    p["height"] = c.frame.height;
    p["importance_lights"] = c.frame.importance_lights;
    p["visibility"] = visibility_name(c.frame.visibility);
    if (c.frame.visibility == Visibility::ism) p["ism"] = {{"size", c.frame.ism.size}, {"points", c.frame.ism.points}};
    for (const auto& [key, value] : c.method_parameters.items()) p[key] = value;
    return p;
  }

  const JsonDocument& doc_;
  FrameParameters base_;
};

FrameParameters base_parameters(const Json& root) {
  FrameParameters base;
  if (root.contains("frame")) {
    base.width = root["frame"]["width"];
    base.height = root["frame"]["height"];
  }
  if (root.contains("ism")) {
    base.ism.size = root["ism"].value("size", base.ism.size);
    base.ism.points = root["ism"].value("points", base.ism.points);
  }
  return base;
}

void read_settings(const Json& root, Config* config) {
  config->name = root["name"];
  config->description = root.value("description", "");
  config->seeds = root.value("seeds", config->seeds);
  const Json timing = root.value("timing", Json::object());
  config->warmup = timing.value("warmup", config->warmup);
  config->timing.min_samples = timing.value("min_samples", config->timing.min_samples);
  config->timing.max_samples = timing.value("max_samples", config->timing.max_samples);
  config->timing.relative_width = timing.value("relative_width", config->timing.relative_width);
  config->timing.time_limit_s = timing.value("time_limit_s", config->timing.time_limit_s);
  const Json reference = root.value("reference", Json::object());
  config->reference.samples = reference.value("samples", config->reference.samples);
  config->reference.batches = reference.value("batches", config->reference.batches);
  config->reference.seed = reference.value("seed", config->reference.seed);
}

Json resolved_settings(const Config& config, const FrameParameters& base, const Json& root) {
  return {{"name", config.name},
          {"description", config.description},
          {"scenes", root["scenes"]},
          {"methods", root["methods"]},
          {"frame", {{"width", base.width}, {"height", base.height}}},
          {"seeds", config.seeds},
          {"reference",
           {{"samples", config.reference.samples},
            {"batches", config.reference.batches},
            {"seed", config.reference.seed}}},
          {"timing",
           {{"warmup", config.warmup},
            {"min_samples", config.timing.min_samples},
            {"max_samples", config.timing.max_samples},
            {"relative_width", config.timing.relative_width},
            {"time_limit_s", config.timing.time_limit_s}}}};
}

}  // namespace

std::filesystem::path config_path(const std::string& name_or_path) {
  if (name_or_path.find('/') != std::string::npos || name_or_path.ends_with(".json")) return name_or_path;
  return data_root() / "configs" / (name_or_path + ".json");
}

Config load_config(const std::filesystem::path& path) {
  const JsonDocument doc = JsonDocument::load(path, ErrorKind::config);
  check_schema(doc, Json::parse(read_text(data_root() / "harness" / "run" / "config.schema.json")));
  const Json& root = doc.root();
  Config config;
  read_settings(root, &config);
  const FrameParameters base = base_parameters(root);
  Sweep sweep(doc, base);
  for (const auto& scene : root["scenes"]) {
    config.scenes.push_back(scene);
    for (size_t i = 0; i < root["methods"].size(); ++i) {
      const Json& entry = root["methods"][i];
      const std::string at = fmt::format("/methods/{}", i);
      const MethodInfo* method = nullptr;
      try {
        method = &find_method(entry["method"].is_string() ? entry["method"].get<std::string>() : entry["method"].dump());
      } catch (const Error& e) {
        throw doc.error(at + "/method", e.what());
      }
      check_entry(doc, entry, at, *method);
      sweep.expand(scene, *method, axes_of(doc, entry, at, *method), at, &config.cases);
    }
  }
  std::set<std::string> ids;
  for (const Case& c : config.cases) {
    if (!ids.insert(c.id).second) throw doc.error("/methods", fmt::format("the case {} comes twice", c.id));
  }
  config.resolved = resolved_settings(config, base, root);
  return config;
}

}  // namespace vsglbench
