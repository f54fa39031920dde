#include "run/sweep.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/nearest.h"
#include "run/case_id.h"
#include "run/config.h"
#include "run/method_keys.h"
#include "run/preset.h"

namespace vsglbench {
namespace {

constexpr size_t kMaxCombinations = 10000;  // of all entries and scenes

// One list of a sweep.
struct Axis {
  std::string name;
  const CaseKey* key;  // null: a parameter of the method's own
  Json values;
  bool named;  // by its entry
  bool is_vsgl() const { return key && (key->scope & kVsgl); }
};

// One entry of `methods`, checked.
class Entry {
 public:
  Entry(const JsonDocument& doc, const Json& root, const Json& root_preset, const Overrides& overrides,
        size_t index)
      : doc_(doc),
        root_(root),
        json_(root.at("methods").at(index)),
        index_(index),
        at_(fmt::format("/methods/{}", index)),
        preset_(preset_of(doc, json_, at_)),
        root_preset_(root_preset),
        method_(find()),
        keys_{method_, root.value("measure", "frame") == "frame"} {
    for (const auto& [key, value] : overrides.items()) preset_.erase(key);
    check_case_defaults();
    check_keys();
    add_axes();
  }

  // Every combination of the lists, also those that repeat a case; `left`: how many may be tried.
  void expand(const FrameParameters& base, size_t* left, std::vector<NamedCase>* out) const {
    std::vector<size_t> index(axes_.size(), 0);
    for (;;) {
      if (*left == 0) throw doc_.error(at_, fmt::format("makes more than {} combinations", kMaxCombinations));
      --*left;
      if (!repeats(index)) out->push_back(make_case(base, index));
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

  void check_case_defaults() const {
    if (method_.case_defaults.is_null()) return;
    for (const auto& [name, value] : method_.case_defaults.items()) {
      if (!find_case_key(name))
        throw doc_.error(at_ + "/method",
                         fmt::format("plugin {}: its case_defaults name '{}', which is no key of every case",
                                     method_.library.string(), name));
    }
  }

  void check_keys() const {
    std::vector<std::string> known = case_key_names();
    known.insert(known.end(), {"method", "preset"});
    for (const auto& parameter : method_.parameters) known.push_back(parameter.name);
    for (const auto& [name, value] : json_.items()) {
      const std::string at = at_ + "/" + pointer_token(name);
      if (keys_.usable() && std::ranges::count(known, name) == 0) throw unknown_key(at, name, known);
      const CaseKey* key = keys_.is_own(name) ? nullptr : find_case_key(name);
      if (key && !keys_.why_unread(*key).empty()) throw doc_.error(at, keys_.why_unread(*key));
      if (value.is_array() && value.empty()) throw doc_.error(at, "is an empty list: it would make no case");
    }
  }

  Error unknown_key(const std::string& at, const std::string& name,
                    const std::vector<std::string>& known) const {
    if (config_schema().at("properties").contains(name))
      return doc_.error(at, "is a key of the whole config, not of an entry");
    return doc_.error(at,
                      fmt::format("unknown key '{}' for {}{}", name, method_.name, suggestion(name, known)));
  }

  void add_axes() {
    for (const CaseKey& key : case_keys()) {
      if (keys_.reads(key)) add_axis(key);
    }
    for (const auto& parameter : method_.parameters) add_own_axis(parameter.name);
    if (keys_.usable()) return;
    for (const auto& [name, value] : json_.items()) {
      if (name != "method" && name != "preset" && !find_case_key(name)) add_own_axis(name);
    }
  }

  // From the entry, its preset, the config's own lists, their preset, the method's own default, or the key's:
  // the first that has the key.
  void add_axis(const CaseKey& key) {
    const std::string own = at_ + "/" + pointer_token(key.name);
    const std::pair<const Json*, std::string> sources[] = {{&json_, own},
                                                           {&preset_, at_ + "/preset"},
                                                           {&root_, "/" + key.name},
                                                           {&root_preset_, "/preset"},
                                                           {&method_.case_defaults, at_ + "/method"}};
    for (const auto& [source, at] : sources) {
      if (source->is_object() && source->contains(key.name))
        return push_axis(key.name, &key, checked(key, source->at(key.name), at), source == &json_);
    }
    push_axis(key.name, &key, key.default_value, false);
  }

  // From the entry or its preset, or the config's; the default is the method's. Of a preset only a name that
  // is not a key of every case: `shading` of all-texels stays exact.
  void add_own_axis(const std::string& name) {
    if (json_.contains(name)) return push_axis(name, nullptr, json_.at(name), true);
    if (find_case_key(name)) return;
    for (const Json* preset : {&std::as_const(preset_), &root_preset_}) {
      if (preset->contains(name)) return push_axis(name, nullptr, preset->at(name), false);
    }
  }

  void push_axis(const std::string& name, const CaseKey* key, const Json& value, bool named) {
    axes_.push_back({name, key, value.is_array() ? value : Json::array({value}), named});
  }

  // The values of a key, as the table writes those that are choices: 0.0 as "0".
  Json checked(const CaseKey& key, const Json& given, const std::string& at) const {
    Json values = given.is_array() ? given : Json::array({given});
    for (Json& value : values) {
      try {
        FrameParameters frame;
        key.read(value, &frame);
        if (key.look_up) key.look_up(frame);
        if (const Json written = key.write(frame); written.is_string()) value = written;
      } catch (const Error& e) {
        throw doc_.error(at, e.what());
      }
    }
    return values;
  }

  // A VPL case with another choice of shading than the first is the same case.
  bool repeats(const std::vector<size_t>& index) const {
    bool first = true;
    for (size_t i = 0; i < axes_.size(); ++i) first = first && (!axes_[i].is_vsgl() || index[i] == 0);
    if (first) return false;
    Json own = own_values(index);
    for (const auto& p : method_.parameters) {
      if (!own.contains(p.name)) own[p.name] = p.default_value;
    }
    return keys_.makes_vpls(own);
  }

  Json own_values(const std::vector<size_t>& index) const {
    Json own = Json::object();
    for (size_t i = 0; i < axes_.size(); ++i) {
      if (!axes_[i].key) own[axes_[i].name] = axes_[i].values.at(index[i]);
    }
    return own;
  }

  NamedCase make_case(const FrameParameters& base, const std::vector<size_t>& index) const {
    NamedCase n{.entry = index_};
    Case& c = n.c;
    c.method = method_.name;
    c.frame = base;
    if (!keys_.shades_frames) c.frame.visibility = Visibility::none;
    const Json own = own_values(index);
    try {
      c.method_parameters = keys_.usable() ? resolve_parameters(method_, own) : own;
    } catch (const Error& e) {
      throw doc_.error(at_, e.what());
    }
    const bool vpls = keys_.makes_vpls(c.method_parameters);
    for (size_t i = 0; i < axes_.size(); ++i) {
      if (axes_[i].key && !(vpls && axes_[i].is_vsgl()))
        axes_[i].key->read(axes_[i].values.at(index[i]), &c.frame);
    }
    if (keys_.usable() && !vpls) read_own_choices(c.method_parameters, &c.frame);
    check_shading(c.frame);
    check_effects(c.frame);
    c.parameters = resolved(c, vpls);
    n.settings = settings(c, index, vpls);
    return n;
  }

  // A parameter of the method's own that bears a key's name, with a choice that the key has, too: it counts
  // as that.
  void read_own_choices(const Json& parameters, FrameParameters* frame) const {
    for (const CaseKey& key : case_keys()) {
      if (keys_.is_own(key.name) && schema_violations(parameters.at(key.name), key.schema).empty())
        key.read(parameters.at(key.name), frame);
    }
  }

  // The disk of [VSGL14] has r² = 2σ² of the three-dimensional variance: halved, it would be another disk's.
  // Filtered BRDFs are exact already, where bias reduction would have them so.
  void check_shading(const FrameParameters& frame) const {
    if (frame.shading.empty()) return;
    const std::string model = chosen(frame.shading, "shading");
    if (model != "vsgl16" && chosen(frame.shading, "variance") == "disk") {
      throw doc_.error(
          at_, fmt::format("makes a case of shading {} with variance disk, which it has no use for: its r² = "
                           "2σ² takes the 3d variance; sweep the two in entries of their own",
                           model));
    }
    if (model == "filtered" && frame.bias_reduction > 0) {
      throw doc_.error(
          at_,
          "makes a case of shading filtered with bias_reduction, which has nothing to reduce: its "
          "BRDFs are exact; sweep the two in entries of their own");
    }
  }

  void check_effects(const FrameParameters& frame) const {
    const EffectSet both = frame.force_effects - (frame.force_effects - frame.skip_effects);
    if (both == EffectSet::none()) return;
    throw doc_.error(at_, fmt::format("makes a case that both forces and skips {}; name it in one of the two",
                                      both == EffectSet::all() ? "all effects" : to_text(both)));
  }

  Json resolved(const Case& c, bool vpls) const {
    Json p = Json::object();
    for (const CaseKey& key : case_keys()) {
      if (keys_.reads(key) && !(vpls && (key.scope & kVsgl))) p[key.name] = key.write(c.frame);
    }
    p["width"] = c.frame.width;
    p["height"] = c.frame.height;
    if (has_shadow_maps(c.frame.visibility))
      p["ism"] = {{"size", c.frame.ism.size}, {"points", c.frame.ism.points}};
    for (const auto& [key, value] : c.method_parameters.items()) p[key] = value;
    return p;
  }

  // The preset, keys of every case, the method's own parameters, and how VSGLs are shaded.
  std::vector<Setting> settings(const Case& c, const std::vector<size_t>& index, bool vpls) const {
    std::vector<Setting> first, last;
    if (json_.contains("preset")) first.push_back({"preset", "preset", json_.at("preset"), true});
    Json own = c.method_parameters;  // as the config writes those that it gives
    for (size_t i = 0; i < axes_.size(); ++i) {
      const auto& [name, key, values, named] = axes_[i];
      if (!key) own[name] = values.at(index[i]);
      if (!key || (vpls && axes_[i].is_vsgl())) continue;
      (axes_[i].is_vsgl() ? last : first)
          .push_back({name, key->name_in_id, values.at(index[i]), named || key->in_id == InId::always});
    }
    for (const auto& [name, value] : own.items()) first.push_back({name, name, value, json_.contains(name)});
    first.insert(first.end(), last.begin(), last.end());
    return first;
  }

  const JsonDocument& doc_;
  const Json &root_, &json_;
  size_t index_;
  std::string at_;
  Json preset_;
  const Json& root_preset_;
  const MethodInfo& method_;
  const MethodKeys keys_;
  std::vector<Axis> axes_;
};

}  // namespace

std::vector<Case> expand_cases(const JsonDocument& doc, const Json& root, const Overrides& overrides,
                               const FrameParameters& base) {
  const Json& scenes = root.at("scenes");
  const Json root_preset = preset_of(doc, root, "");
  std::vector<Entry> entries;
  for (size_t i = 0; i < root.at("methods").size(); ++i)
    entries.emplace_back(doc, root, root_preset, overrides, i);
  std::vector<NamedCase> made;
  size_t left = kMaxCombinations / scenes.size();
  for (const Entry& entry : entries) entry.expand(base, &left, &made);
  name_cases(&made);

  std::map<std::string, std::string> ids;  // by fingerprint
  std::set<std::string> taken;
  for (const NamedCase& n : made) {
    const auto [same, fresh] = ids.emplace(fingerprint(n.c), n.c.id);
    if (fresh && !taken.insert(n.c.id).second) {
      throw doc.error(entries[n.entry].at(),
                      fmt::format("makes two cases with the id {}, in which the / of a "
                                  "path is a -; rename a file",
                                  n.c.id));
    }
    if (fresh) continue;
    const std::string scene = scenes.at(0).get<std::string>() + "/";
    const std::string as = same->second == n.c.id ? "" : fmt::format(", first as {}", scene + same->second);
    throw doc.error(entries[n.entry].at(), fmt::format("the case {} comes twice{}", scene + n.c.id, as));
  }

  std::vector<Case> cases;
  for (const auto& scene : scenes) {
    for (const NamedCase& n : made) {
      cases.push_back(n.c);
      cases.back().scene = scene.get<std::string>();
      cases.back().id = fmt::format("{}/{}", cases.back().scene, n.c.id);
    }
  }
  return cases;
}

}  // namespace vsglbench
