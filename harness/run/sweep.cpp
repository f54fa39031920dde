#include "run/sweep.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/nearest.h"
#include "method/registry.h"
#include "run/preset.h"

namespace vsglbench {
namespace {

constexpr size_t kMaxCases = 100000;
constexpr int64_t kMaxCount = 1 << 30, kMaxRsm = 16384, kMaxIterations = 1024;

// One list of a sweep: its key, values, and where they stand in the file.
struct Axis {
  std::string key, at;
  Json values;
  bool named = false;  // part of the case's id
};

std::vector<std::string> case_keys() {
  std::vector<std::string> keys;
  for (const auto& [key, value] : case_defaults().items()) keys.push_back(key);
  return keys;
}

// Keys that mean nothing to VPLs, which have exact BRDFs; and those that mean nothing where no frame is
// shaded.
bool is_vsgl_key(const std::string& key) { return is_shading_key(key) || key == "bias_reduction"; }
bool is_frame_key(const std::string& key) {
  return is_vsgl_key(key) || key == "visibility" || key == "importance" || key == "progressive";
}

// Those of the PDF, which methods that draw no lights make no use of.
bool is_pdf_key(const std::string& key) { return key == "importance" || key == "importance_lights"; }

bool always_named(const std::string& key) { return key == "N" || key == "rsm" || key == "visibility"; }

// "vis=exact": short, since it becomes part of a file's name.
std::string name_of(const std::string& key, const Json& value) {
  std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  std::ranges::replace(text, '/', '-');  // that of "papers/mfis16"
  return fmt::format("{}={}", key == "visibility" ? "vis" : key, text);
}

// Equal for equal parameters, whichever way their numbers are written.
std::string fingerprint(const Case& c) {
  std::string out = fmt::format("{}\n{}", c.scene, c.method);
  for (const auto& [key, value] : c.parameters.items()) {
    out += fmt::format("\n{}={}", key,
                       value.is_number() ? fmt::format("{}", value.get<double>()) : value.dump());
  }
  return out;
}

// One entry of `methods`, checked.
class Entry {
 public:
  Entry(const JsonDocument& doc, size_t index)
      : doc_(doc),
        json_(doc.root().at("methods").at(index)),
        at_(fmt::format("/methods/{}", index)),
        sees_(doc.root().value("measure", "frame") == "frame"),
        preset_(preset_of(doc, json_, at_)),
        root_preset_(preset_of(doc, doc.root(), "")),
        method_(find()) {
    check_keys();
    add_axes();
  }

  // Every combination of the lists, for one scene.
  void expand(const std::string& scene, const FrameParameters& base, std::vector<Case>* out) const {
    std::vector<size_t> index(axes_.size(), 0);
    for (;;) {
      if (out->size() == kMaxCases) throw doc_.error(at_, fmt::format("makes more than {} cases", kMaxCases));
      if (!repeats(index)) out->push_back(make_case(scene, base, index));
      size_t i = axes_.size();
      while (i > 0 && ++index[i - 1] == axes_[i - 1].values.size()) index[--i] = 0;
      if (i == 0) return;
    }
  }

  const std::string& at() const { return at_; }

 private:
  const MethodInfo& find() const {
    const Json& name = json_.at("method");
    if (!name.is_string()) throw doc_.error(at_ + "/method", "must be the name of a method");
    try {
      return find_method(name.get<std::string>());
    } catch (const Error& e) {
      throw doc_.error(at_ + "/method", e.what());
    }
  }

  // A plugin that was refused costs its own cases and nothing else: they are made, and fail. What parameters
  // it has is not known.
  bool usable() const { return method_.refused.empty(); }

  // Whether lights made with these parameters are VPLs: always, or by what `makes_vpls` says.
  bool makes_vpls(const Json& parameters) const {
    if (method_.makes_vpls.is_null()) return false;
    const auto& when = method_.makes_vpls.items();
    return std::all_of(when.begin(), when.end(), [&](const auto& item) {
      return parameters.contains(item.key()) && parameters.at(item.key()) == item.value();
    });
  }
  // A parameter of the method that bears the name of a shading key is read in its place; a choice that the
  // key has, too, counts as that.
  bool is_own(const std::string& key) const {
    return std::ranges::any_of(method_.parameters, [&](const auto& p) { return p.name == key; });
  }
  bool reads_shading() const {
    return sees_ && !(method_.makes_vpls.is_object() && method_.makes_vpls.empty());
  }

  // A VPL case with another choice of shading than the first is the same case.
  bool repeats(const std::vector<size_t>& index) const {
    Json own = Json::object();
    bool first = true;
    for (size_t i = 0; i < axes_.size(); ++i) {
      own[axes_[i].key] = axes_[i].values.at(index[i]);
      first = first && (!is_vsgl_key(axes_[i].key) || is_own(axes_[i].key) || index[i] == 0);
    }
    for (const auto& p : method_.parameters) {
      if (!own.contains(p.name)) own[p.name] = p.default_value;
    }
    return !first && makes_vpls(own);
  }

  void check_keys() const {
    std::vector<std::string> known = case_keys();
    known.insert(known.end(), {"method", "preset"});
    for (const auto& parameter : method_.parameters) known.push_back(parameter.name);
    for (const auto& [key, value] : json_.items()) {
      const std::string at = at_ + "/" + pointer_token(key);
      if (usable() && std::find(known.begin(), known.end(), key) == known.end()) {
        throw doc_.error(at,
                         fmt::format("unknown key '{}' for {}{}", key, method_.name, suggestion(key, known)));
      }
      if (key == "N" && !method_.takes_light_count) {
        const std::string makes = method_.light_count > 0 ? fmt::format("{} lights", method_.light_count)
                                                          : "a light of every texel";
        throw doc_.error(at, fmt::format("is not read: {} makes {}", method_.name, makes));
      }
      if (is_pdf_key(key) && !method_.takes_light_count)
        throw doc_.error(at, fmt::format("is not read: {} draws no lights", method_.name));
      if (is_frame_key(key) && !is_own(key) && !sees_)
        throw doc_.error(at, "is not read where only generation is measured");
      if (is_vsgl_key(key) && !is_own(key) && !reads_shading())
        throw doc_.error(at, fmt::format("is not read: {} makes VPLs, with exact BRDFs", method_.name));
      if (value.is_array() && value.empty()) throw doc_.error(at, "is an empty list: it would make no case");
    }
  }

  void add_axes() {
    for (const auto& key : case_keys()) {
      const bool read = is_own(key)                                     ? false
                        : key == "N"                                    ? method_.takes_light_count
                        : is_pdf_key(key) && !method_.takes_light_count ? false
                        : is_vsgl_key(key)                              ? reads_shading()
                        : is_frame_key(key)                             ? sees_
                                                                        : true;
      if (read) add_axis(key, true);
    }
    for (const auto& parameter : method_.parameters) add_axis(parameter.name, false);
    if (usable()) return;
    for (const auto& [key, value] : json_.items()) {
      if (key != "method" && key != "preset" && !case_defaults().contains(key)) add_axis(key, false);
    }
  }

  // From the entry, its preset, the config's own lists, their preset, or the default: the first that has the
  // key. A method's own parameter has no list in the config, its default in the method, and of a preset only
  // a name that is not a key of every case: `shading` of all-texels stays exact.
  void add_axis(const std::string& key, bool of_every_case) {
    const Json& root = doc_.root();
    const bool given = of_every_case || !case_defaults().contains(key);  // by presets
    Axis axis{key, "", {}, always_named(key)};
    const Json* value = nullptr;
    if (json_.contains(key)) {
      value = &json_.at(key);
      axis.at = at_ + "/" + pointer_token(key);
      axis.named = true;
    } else if (given && preset_.contains(key)) {
      value = &preset_.at(key);
      axis.at = at_ + "/preset";
    } else if (of_every_case && root.contains(key)) {
      value = &root.at(key);
      axis.at = "/" + key;
    } else if (given && root_preset_.contains(key)) {
      value = &root_preset_.at(key);
      axis.at = "/preset";
    } else if (of_every_case) {
      value = &case_defaults().at(key);
      axis.at = "/" + key;
    } else {
      return;
    }
    axis.values = value->is_array() ? *value : Json::array({*value});
    axis.named = axis.named || axis.values.size() > 1;
    axes_.push_back(std::move(axis));
  }

  Case make_case(const std::string& scene, const FrameParameters& base,
                 const std::vector<size_t>& index) const {
    Case c;
    c.scene = scene;
    c.method = method_.name;
    c.frame = base;
    if (!sees_) c.frame.visibility = Visibility::none;
    std::string names = json_.contains("preset") ? name_of("preset", json_.at("preset")) : "";
    Json own = Json::object();
    for (size_t i = 0; i < axes_.size(); ++i) {
      const Axis& axis = axes_[i];
      const Json& value = axis.values.at(index[i]);
      if (is_own(axis.key) || !set(axis, value, &c.frame)) own[axis.key] = value;
      if (axis.named && (is_own(axis.key) || !is_vsgl_key(axis.key)))
        names += fmt::format("{}{}", names.empty() ? "" : ",", name_of(axis.key, value));
    }
    try {
      c.method_parameters = usable() ? resolve_parameters(method_, own) : own;
    } catch (const Error& e) {
      throw doc_.error(at_, e.what());
    }
    for (const ShadingAxis& axis : shading_axes()) {
      if (!is_own(axis.key) || !usable()) continue;
      const auto chosen = c.method_parameters.at(axis.key).get<std::string>();
      if (std::ranges::count(axis.choices, chosen) > 0) c.frame.shading[axis.key] = chosen;
    }
    if (makes_vpls(c.method_parameters)) {
      c.frame.shading.clear();
      c.frame.bias_reduction = 0;
    } else {
      for (size_t i = 0; i < axes_.size(); ++i) {
        if (axes_[i].named && is_vsgl_key(axes_[i].key) && !is_own(axes_[i].key))
          names += "," + name_of(axes_[i].key, axes_[i].values.at(index[i]));
      }
    }
    check_variance(c.frame.shading);
    c.id = fmt::format("{}/{}/{}", scene, method_.name, names);
    c.parameters = resolved(c);
    return c;
  }

  // The disk of [VSGL14] has r² = 2σ² of the three-dimensional variance: halved, it would be another disk's.
  void check_variance(const Shading& shading) const {
    if (shading.empty() || chosen(shading, "shading") != "vsgl14" || chosen(shading, "variance") != "disk")
      return;
    throw doc_.error(
        at_,
        "makes a case of shading vsgl14 with variance disk, which vsgl14 has no use for: its r² = 2σ² "
        "takes the 3d variance; sweep the two in entries of their own");
  }

  // Whether the key is one that every case has; then its value is in `frame`.
  bool set(const Axis& axis, const Json& value, FrameParameters* frame) const {
    if (axis.key == "N") {
      frame->lights = count(axis, value, 0, kMaxCount);
    } else if (axis.key == "rsm") {
      frame->rsm = count(axis, value, 1, kMaxRsm);
    } else if (axis.key == "importance_lights") {
      frame->importance_lights = count(axis, value, 1, kMaxCount);
    } else if (axis.key == "visibility") {
      frame->visibility = choice(axis, value, parse_visibility);
    } else if (axis.key == "importance") {
      frame->importance = choice(axis, value, parse_importance);
    } else if (axis.key == "progressive") {
      frame->iterations = count(axis, value, 1, kMaxIterations);
    } else if (axis.key == "bias_reduction") {
      frame->bias_reduction = number(axis, value, 1e30);
    } else if (is_shading_key(axis.key)) {
      frame->shading[axis.key] = shading_choice(axis, value);
    } else {
      return false;
    }
    return true;
  }

  uint32_t count(const Axis& axis, const Json& value, int64_t minimum, int64_t maximum) const {
    const bool good = value.is_number_integer() && value.get<double>() >= static_cast<double>(minimum) &&
                      value.get<double>() <= static_cast<double>(maximum);
    if (!good)
      throw doc_.error(axis.at,
                       fmt::format("{} must be an integer within {} … {}", value.dump(), minimum, maximum));
    return value.get<uint32_t>();
  }

  float number(const Axis& axis, const Json& value, double maximum) const {
    if (!value.is_number() || !(value.get<double>() >= 0) || value.get<double>() > maximum)
      throw doc_.error(axis.at, fmt::format("{} must be a number within 0 … {}", value.dump(), maximum));
    return std::abs(value.get<float>());  // -0 is 0
  }

  template <class Choice>
  Choice choice(const Axis& axis, const Json& value, Choice (*parse)(const std::string&)) const {
    try {
      return parse(value.is_string() ? value.get<std::string>() : value.dump());
    } catch (const Error& e) {
      throw doc_.error(axis.at, e.what());
    }
  }

  // As text, also where it is written as a number.
  std::string shading_choice(const Axis& axis, const Json& value) const {
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    try {
      check_shading_choice(axis.key, text);
    } catch (const Error& e) {
      throw doc_.error(axis.at, e.what());
    }
    return text;
  }

  Json resolved(const Case& c) const {
    Json p = Json::object();
    if (method_.takes_light_count) p["N"] = c.frame.lights;
    p["rsm"] = c.frame.rsm;
    p["width"] = c.frame.width;
    p["height"] = c.frame.height;
    if (method_.takes_light_count) p["importance_lights"] = c.frame.importance_lights;
    if (sees_) p["visibility"] = visibility_name(c.frame.visibility);
    if (has_shadow_maps(c.frame.visibility))
      p["ism"] = {{"size", c.frame.ism.size}, {"points", c.frame.ism.points}};
    if (sees_ && method_.takes_light_count)
      p["importance"] = importance_names()[static_cast<size_t>(c.frame.importance)];
    if (sees_) p["progressive"] = c.frame.iterations;
    for (const auto& [key, choice] : c.frame.shading) p[key] = choice;
    if (!c.frame.shading.empty()) p["bias_reduction"] = c.frame.bias_reduction;
    for (const auto& [key, value] : c.method_parameters.items()) p[key] = value;
    return p;
  }

  const JsonDocument& doc_;
  const Json& json_;
  std::string at_;
  bool sees_;  // a frame is shaded, and visibility matters
  Json preset_, root_preset_;
  const MethodInfo& method_;
  std::vector<Axis> axes_;
};

}  // namespace

const Json& case_defaults() {
  static const Json defaults = [] {
    Json all = {{"N", 256},
                {"rsm", 256},
                {"importance_lights", 2048},
                {"visibility", "exact"},
                {"importance", "own"},
                {"progressive", 1},
                {"bias_reduction", 0}};
    for (const ShadingAxis& axis : shading_axes()) all[axis.key] = axis.choices.front();
    return all;
  }();
  return defaults;
}

std::vector<Case> expand_cases(const JsonDocument& doc, const FrameParameters& base) {
  std::vector<Entry> entries;
  for (size_t i = 0; i < doc.root().at("methods").size(); ++i) entries.emplace_back(doc, i);
  std::vector<Case> cases;
  std::map<std::string, std::string> ids;  // by fingerprint
  for (const auto& scene : doc.root().at("scenes")) {
    for (const Entry& entry : entries) {
      size_t next = cases.size();
      entry.expand(scene.get<std::string>(), base, &cases);
      for (; next < cases.size(); ++next) {
        const Case& c = cases[next];
        const auto [same, fresh] = ids.emplace(fingerprint(c), c.id);
        if (fresh) continue;
        const std::string as = same->second == c.id ? "" : fmt::format(", first as {}", same->second);
        throw doc.error(entry.at(), fmt::format("the case {} comes twice{}", c.id, as));
      }
    }
  }
  return cases;
}

}  // namespace vsglbench
