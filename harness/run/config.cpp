#include "run/config.h"

#include <algorithm>
#include <functional>
#include <map>

#include "base/error.h"
#include "base/file.h"
#include "base/nearest.h"
#include "base/percent.h"
#include "run/case_keys.h"
#include "run/method_keys.h"
#include "run/overrides.h"
#include "run/pdf_source.h"
#include "run/preset.h"
#include "run/scene_choice.h"
#include "scene/model_scene.h"
#include "scene/scene_file.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

// Names of what lies in a folder of the data: "quick" for configs/quick.json, "cornell" for scenes/cornell.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(folder, ec)) {
    if (fs::exists(entry.path() / "scene.json", ec) || entry.path().extension() == ".json")
      names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// Scene file and view, the same for "cornell", its default view by name, and its path; the scene as it stands
// where the file can't be read: that shows when it is loaded.
std::string identity_of(const std::string& scene, const fs::path& file, std::string view) {
  try {
    if (view.empty())
      view = JsonDocument::load(file, ErrorKind::scene).root().at("default_view").get<std::string>();
    return fs::canonical(file).string() + ":" + view;
  } catch (const std::exception&) {
    return scene;
  }
}

// A scene that is misspelt is found now, not after an hour of measuring others. Whether its geometry is there
// and sound shows when it is loaded. Returns what two names of the same scene share.
std::string check_scene_name(const std::string& scene) {
  const SceneName name = parse_scene_name(scene);
  std::error_code ec;
  fs::path file = data_root() / "scenes" / name.scene / "scene.json";
  if (is_path(name.scene)) {
    file = fs::is_directory(name.scene, ec) ? fs::path(name.scene) / "scene.json" : fs::path(name.scene);
    if (!fs::exists(file, ec))
      throw fail(ErrorKind::config, "no scene '{}': {} does not exist", name.scene, file.string());
  } else if (!fs::exists(file, ec) || name.scene.empty()) {
    throw fail(ErrorKind::config, "no scene '{}'{}", name.scene,
               suggestion(name.scene, names_in(data_root() / "scenes")));
  }
  return identity_of(scene, file, name.view.value_or(""));
}

// Lists of effects: the schema could only say that they don't match a pattern of all of them.
void check_effects(const JsonDocument& doc) {
  for (const CaseKey& key : case_keys()) {
    if (!key.schema.contains("pattern") || !doc.root().is_object() || !doc.root().contains(key.name))
      continue;
    const Json& value = doc.root().at(key.name);
    for (const Json& each : value.is_array() ? value : Json::array({value})) {
      if (!each.is_string()) continue;
      try {
        FrameParameters unused;
        key.read(each, &unused);
      } catch (const Error& e) {
        throw doc.error("/" + key.name, e.what());
      }
    }
  }
}

void check_keys(const JsonDocument& doc) {
  check_effects(doc);
  check_schema(doc, config_schema());
}

// The file with the keys of one of its scales, and none of the others.
JsonDocument at_scale(const JsonDocument& file, const std::string& scale) {
  const Json scales = file.root().value("scales", Json::object());
  if (!scale.empty() && !scales.contains(scale)) {
    std::vector<std::string> known;
    for (const auto& item : scales.items()) known.push_back(item.key());
    throw file.error("", known.empty()
                             ? fmt::format("has no scale '{}', nor any other", scale)
                             : fmt::format("has no scale '{}'; it has {}", scale, fmt::join(known, ", ")));
  }
  Json patch = scale.empty() ? Json::object() : scales.at(scale);
  if (patch.contains("scales")) throw file.error("/scales/" + pointer_token(scale), "has scales of its own");
  patch["scales"] = nullptr;
  const JsonDocument doc = file.patched(patch);
  try {
    check_keys(doc);
  } catch (const Error& e) {  // it stands in the scale, whatever stands elsewhere under this name
    const std::string message = e.what();
    throw file.error("/scales/" + pointer_token(scale),
                     message.substr(message.find(": ", doc.name().size()) + 2));
  }
  return doc;
}

// `said(i, what)`: the error that says what is wrong with scene i.
void check_scenes(const std::vector<std::string>& scenes,
                  const std::function<Error(size_t, const std::string&)>& said) {
  std::map<std::string, std::string> seen;  // name, by what it stands for
  for (size_t i = 0; i < scenes.size(); ++i) {
    std::string identity;
    try {
      identity = check_scene_name(scenes[i]);
    } catch (const Error& e) {
      throw said(i, e.what());
    }
    const auto [first, fresh] = seen.emplace(identity, scenes[i]);
    if (fresh) continue;
    const std::string as = first->second == scenes[i] ? "" : fmt::format(", first as {}", first->second);
    throw said(i, fmt::format("the scene {} comes twice{}", scenes[i], as));
  }
}

// Puts `choice` into a config.
void apply(const SceneChoice& choice, Json* root) {
  if (choice.scenes.empty()) return;
  check_scenes(choice.scenes, [&](size_t i, const std::string& what) {
    return fail(ErrorKind::usage, "--scene {}: {}", i + 1, what);
  });
  (*root)["scenes"] = choice.scenes;
  if (!choice.names_it) return;
  const std::string scene = parse_scene_name(choice.scenes.front()).scene;
  const fs::path path = scene.ends_with('/') ? fs::path(scene).parent_path() : fs::path(scene);
  (*root)["name"] = model_name(path.filename() == "scene.json" ? fs::absolute(path).parent_path() : path);
  (*root)["description"] =
      fmt::format("{}, of {}", fmt::join(choice.scenes, ", "), root->value("description", ""));
}

// From the config, else from its preset, else the default.
FrameParameters base_parameters(const Json& root, const Json& preset) {
  FrameParameters base;
  const Json own = root.value("frame", Json::object()), given = preset.value("frame", Json::object());
  base.width = own.value("width", given.value("width", base.width));
  base.height = own.value("height", given.value("height", base.height));
  const Json maps = root.value("ism", Json::object()), given_maps = preset.value("ism", Json::object());
  base.ism.size = maps.value("size", given_maps.value("size", base.ism.size));
  base.ism.points = maps.value("points", given_maps.value("points", base.ism.points));
  return base;
}

void read_timing(const JsonDocument& doc, Config* config) {
  const Json timing = doc.root().value("timing", Json::object());
  StoppingRule& rule = config->timing;
  config->warmup = timing.value("warmup", config->warmup);
  rule.min_samples = timing.value("min_samples", rule.min_samples);
  rule.max_samples = timing.value("max_samples", std::max(rule.min_samples, rule.max_samples));
  rule.relative_width = timing.value("relative_width", rule.relative_width);
  rule.time_limit_s = timing.value("time_limit_s", rule.time_limit_s);
  if (rule.max_samples < rule.min_samples) {
    throw doc.error("/timing/max_samples",
                    fmt::format("{} is under min_samples, {}", rule.max_samples, rule.min_samples));
  }
}

void read_reference(const JsonDocument& doc, Config* config) {
  const Json reference = doc.root().value("reference", Json::object());
  ReferenceSettings& r = config->reference;
  r.samples = reference.value("samples", r.samples);
  r.batches = reference.value("batches", r.batches);
  r.seed = reference.value("seed", r.seed);
  r.time_limit_s = reference.value("time_limit_s", r.time_limit_s);
  r.shading_normals = *shading_normals_named(reference.value("shading_normals", "light"));
  if (reference.contains("floor")) {
    const std::string text = reference["floor"];
    r.floor = parse_percent(text).value_or(0);
    if (!(r.floor > 0 && r.floor < 200)) {
      throw doc.error("/reference/floor",
                      fmt::format("'{}' is no noise floor; give percent of SMAPE, such as \"2%\"", text));
    }
  } else if (reference.contains("time_limit_s")) {
    throw doc.error("/reference/time_limit_s", "only ends the search for a `floor`; give one");
  }
  if (r.batches % 2 != 0) {
    throw doc.error("/reference/batches",
                    fmt::format("{} must be even: its two halves are compared", r.batches));
  }
}

void read_motion(const JsonDocument& doc, Config* config) {
  if (!doc.root().contains("motion")) return;
  MotionSettings& motion = config->motion.emplace();
  motion.frames = doc.root().at("motion").value("frames", motion.frames);
  motion.seeds = doc.root().at("motion").value("seeds", motion.seeds);
}

// What only an image is judged with is refused where there is none, and what stands in for it where there is.
Measure read_measure(const JsonDocument& doc) {
  if (doc.root().value("measure", "frame") == "frame") {
    for (const CaseKey& key : case_keys()) {
      if ((key.scope & kGeneration) && doc.root().contains(key.name))
        throw doc.error("/" + key.name, unread_in_frames(key.name));
    }
    return Measure::frame;
  }
  std::vector<std::string> unread = {"seeds", "reference", "ism", "motion", "price_effects"};
  for (const CaseKey& key : case_keys()) {
    if (key.scope & kFrame) unread.push_back(key.name);
  }
  for (const auto& key : unread) {
    if (doc.root().contains(key))
      throw doc.error(fmt::format("/{}", key), "is not read where only generation is measured");
  }
  return Measure::generation;
}

// An image that is damaged is found now, not after an hour of measuring other cases.
Json read_pdfs(const JsonDocument& doc, const std::vector<Case>& cases) {
  try {
    return describe_pdfs(cases);
  } catch (const Error& e) {
    throw doc.error("/pdf", e.what());
  }
}

// `pdfs`: what read_pdfs() says, of generation alone.
Json resolved_settings(const Config& config, const FrameParameters& base, const Json& root,
                       const Json& preset, const Json& pdfs) {
  const bool generation = config.measure == Measure::generation;
  Json out = {{"name", config.name},
              {"description", config.description},
              {"measure", std::string(name(config.measure))},
              {"scenes", config.scenes},
              {"methods", root.at("methods")},
              {"frame", {{"width", base.width}, {"height", base.height}}}};
  if (root.contains("preset")) out["preset"] = root.at("preset");
  for (const CaseKey& key : case_keys()) {
    if (!(key.scope & (generation ? kFrame : kGeneration)))
      out[key.name] = root.value(key.name, preset.value(key.name, key.default_value));
  }
  if (!generation) {
    out["ism"] = {{"size", base.ism.size}, {"points", base.ism.points}};
    out["seeds"] = config.seeds;
    if (config.price_effects > 0) out["price_effects"] = config.price_effects;
    out["reference"] = {{"samples", config.reference.samples},
                        {"batches", config.reference.batches},
                        {"seed", config.reference.seed},
                        {"shading_normals", std::string(name(config.reference.shading_normals))}};
    if (config.reference.floor > 0) {
      out["reference"]["floor"] = fmt::format("{}%", config.reference.floor);
      out["reference"]["time_limit_s"] = config.reference.time_limit_s;
    }
  }
  if (config.motion) {
    out["motion"] = {{"seeds", config.motion->seeds}};
    if (config.motion->frames > 0) out["motion"]["frames"] = config.motion->frames;
  }
  if (generation) out.update(pdfs);
  out["time_limit_s"] = config.time_limit_s;
  out["timing"] = {{"warmup", config.warmup},
                   {"min_samples", config.timing.min_samples},
                   {"max_samples", config.timing.max_samples},
                   {"relative_width", config.timing.relative_width},
                   {"time_limit_s", config.timing.time_limit_s}};
  return out;
}

}  // namespace

fs::path config_path(const std::string& name_or_path) {
  std::error_code ec;
  if (is_path(name_or_path) || fs::exists(name_or_path, ec)) return name_or_path;
  const fs::path path = data_root() / "configs" / (name_or_path + ".json");
  if (fs::exists(path, ec)) return path;
  throw fail(ErrorKind::config, "no config '{}'{}", name_or_path,
             suggestion(name_or_path, names_in(data_root() / "configs")));
}

const Json& config_schema() {
  static const Json schema =
      JsonDocument::load(data_root() / "harness" / "run" / "config.schema.json", ErrorKind::config).root();
  return schema;
}

Config load_config(const fs::path& path, const Overrides& overrides, const std::string& scale) {
  return load_config(path, overrides, scale, SceneChoice());
}

Config load_config(const fs::path& path, const Overrides& overrides, const std::string& scale,
                   const SceneChoice& choice) {
  const JsonDocument file = JsonDocument::load(path, ErrorKind::config);
  if (file.root().is_object() && file.root().contains("figure")) {
    throw file.error("/figure", fmt::format("describes a figure; draw it with `vsglbench figure {}`",
                                            path.stem().string()));
  }
  check_keys(file);
  const JsonDocument doc = at_scale(file, scale);
  Json root = doc.root();
  apply(overrides, &root);
  apply(choice, &root);
  Config config;
  config.name = root.at("name");
  config.description = root.value("description", "");
  config.scenes = root.at("scenes").get<std::vector<std::string>>();
  config.measure = read_measure(doc);
  config.seeds = root.value("seeds", config.seeds);
  config.price_effects = root.value("price_effects", config.price_effects);
  config.time_limit_s = root.value("time_limit_s", config.time_limit_s);
  if (choice.scenes.empty()) {
    check_scenes(config.scenes, [&](size_t i, const std::string& what) {
      return doc.error(fmt::format("/scenes/{}", i), what);
    });
  }
  read_timing(doc, &config);
  read_reference(doc, &config);
  read_motion(doc, &config);
  const Json preset = preset_of(doc, root, "");
  const FrameParameters base = base_parameters(root, preset);
  config.cases = expand_cases(doc, root, overrides, base);
  check_read(overrides, config.cases);
  const Json pdfs = config.measure == Measure::generation ? read_pdfs(doc, config.cases) : Json::object();
  config.resolved = resolved_settings(config, base, root, preset, pdfs);
  if (!scale.empty()) config.resolved["scale"] = scale;
  if (!overrides.empty()) config.resolved["set"] = overrides;
  return config;
}

}  // namespace vsglbench
