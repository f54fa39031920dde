#include "dashboard/digest.h"

#include <algorithm>
#include <map>
#include <set>

#include "answer/point.h"
#include "dashboard/columns.h"
#include "report/case_names.h"
#include "report/noise.h"

namespace vsglbench {
namespace {

Json effect_json(const EffectReport& e) {
  Json out = {{"name", e.name},
              {"needed", e.needed},
              {"reason", e.reason},
              {"passes", e.passes},
              {"ms", rounded(e.ms)},
              {"ms_ci95", nullptr},
              {"bytes", e.bytes ? Json(*e.bytes) : Json(nullptr)}};
  if (e.ms_ci95) out["ms_ci95"] = {rounded(e.ms_ci95->lo), rounded(e.ms_ci95->hi)};
  return out;
}

Json scene_json(const SceneReport& s) {
  Json effects = Json::array();
  for (const EffectReport& e : s.effects) effects.push_back(effect_json(e));
  Json priced = nullptr;
  if (s.effects_priced) {
    const Ratio& r = s.effects_priced->ratio;
    priced = {{"case", s.effects_priced->case_id},
              {"ratio", rounded(r.value)},
              {"ratio_ci95", {rounded(r.ci95.lo), rounded(r.ci95.hi)}}};
  }
  return {{"name", s.name},
          {"hash", s.hash},
          {"triangles", s.triangles},
          {"exposure", s.exposure},
          {"warnings", s.warnings},
          {"notes", s.notes},
          {"effects", std::move(effects)},
          {"priced", std::move(priced)}};
}

std::string text_of(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

// Settings that all cases have with one value.
Json shared_settings(const Report& report) {
  std::map<std::string, std::set<std::string>> values;
  std::map<std::string, size_t> count;
  for (const CaseResult& c : report.cases) {
    for (const auto& [key, value] : c.parameters.items()) {
      values[key].insert(text_of(value));
      ++count[key];
    }
  }
  Json out = Json::object();
  for (const auto& [key, set] : values) {
    if (set.size() == 1 && count[key] == report.cases.size()) out[key] = *set.begin();
  }
  return out;
}

// "vsglbench run front", without the path of the programme.
std::string command_text(const Report& report) {
  if (report.argv.empty()) return "";
  std::string out = std::filesystem::path(report.argv.front()).filename().string();
  for (size_t i = 1; i < report.argv.size(); ++i) out += " " + report.argv[i];
  return out;
}

Json time_names(const Report& report) {
  Json out = Json::array();
  // What is asked for first comes first.
  std::vector<std::string> names = {"method", "frame"};
  for (const std::string& n : time_columns()) {
    if (std::ranges::count(names, n) == 0) names.push_back(n);
  }
  for (const std::string& n : names) {
    const bool has = std::ranges::any_of(report.cases, [&](const CaseResult& c) {
      return time_of(c, n) || (n == "method" && !c.passes.empty() && method_time(c.passes));
    });
    if (has) out.push_back({{"name", n}, {"words", time_words(n)}});
  }
  return out;
}

std::string text_or(const Json& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_string() ? it->get<std::string>() : "";
}

uint32_t frame_side(const Report& report, const char* key) {
  for (const CaseResult& c : report.cases) {
    if (const auto it = c.parameters.find(key); it != c.parameters.end() && it->is_number())
      return it->get<uint32_t>();
  }
  return 0;
}

}  // namespace

int scene_index(const Report& report, const std::string& name) {
  const auto it = std::ranges::find(report.scenes, name, &SceneReport::name);
  return it == report.scenes.end() ? -1 : static_cast<int>(it - report.scenes.begin());
}

std::string config_name(const Report& report) { return text_or(report.config, "name"); }

std::vector<std::string> methods_of(const Report& report) {
  std::vector<std::string> methods;
  for (const CaseResult& c : report.cases) {
    if (std::ranges::count(methods, c.method) == 0) methods.push_back(c.method);
  }
  return methods;
}

std::vector<std::string> pass_names(const Report& report) {
  std::vector<std::string> names;
  for (const CaseResult& c : report.cases) {
    size_t next = 0;  // where a pass belongs that comes after the last one
    for (const PassTiming& p : c.passes) {
      const auto at = std::ranges::find(names, p.pass.name());
      if (at == names.end())
        names.insert(names.begin() + static_cast<std::ptrdiff_t>(next++), p.pass.name());
      else
        next = static_cast<size_t>(at - names.begin()) + 1;
    }
  }
  return names;
}

DigestGroups digest_groups(const Report& report) {
  DigestGroups out;
  std::map<std::pair<std::string, std::string>, int> known;  // by scene and reference
  for (const CaseResult& c : report.cases) {
    if (!c.accuracy || c.status != Status::ok) {
      out.of_case.push_back(-1);
      continue;
    }
    const std::string& hash = c.accuracy->reference.hash;
    const auto [at, added] = known.try_emplace({c.scene, hash}, static_cast<int>(out.list.size()));
    out.of_case.push_back(at->second);
    if (!added) continue;
    Json noise = Json::object();
    for (const std::string& time : time_columns()) {
      if (const TimeNoise* n = noise_of(report, c.scene, time)) noise[time] = rounded(n->noise_floor);
    }
    const bool none = text_or(c.parameters, "visibility") == "none";
    out.list.push_back({{"scene", scene_index(report, c.scene)},
                        {"visibility", none ? "none" : "full"},
                        {"reference", hash},
                        {"noise", noise},
                        {"floor", Json::object()}});
  }
  for (const Json& metric : digest_metrics(report)) {
    const auto name = metric.at("name").get<std::string>();
    for (const PointGroup& g : point_groups(report, {name, "method"})) {
      if (g.error_floor > 0)
        out.list[known.at({g.scene, g.reference})]["floor"][name] = rounded(g.error_floor);
    }
  }
  return out;
}

Json digest_of(const Report& report, const std::string& file) {
  const DigestGroups groups = digest_groups(report);
  DigestAnswers answers = digest_answers(report, groups);
  Json scenes = Json::array();
  for (const SceneReport& s : report.scenes) scenes.push_back(scene_json(s));
  return {
      {"file", file},
      {"name", config_name(report)},
      {"description", text_or(report.config, "description")},
      {"measure", text_or(report.config, "measure").empty() ? "frame" : text_or(report.config, "measure")},
      {"created", report.created},
      {"commit", report.git.commit == "unknown" ? "" : report.git.commit},
      {"dirty", report.git.dirty},
      {"complete", report.complete},
      {"command", command_text(report)},
      {"device", report.device.name},
      {"device_type", report.device.type},
      {"driver", report.device.driver + " " + report.device.driver_version},
      {"host", report.host.cpu},
      {"width", frame_side(report, "width")},
      {"height", frame_side(report, "height")},
      {"wall_s", rounded(report.wall.total_s)},
      {"settings", shared_settings(report)},
      {"scenes", std::move(scenes)},
      {"methods", methods_of(report)},
      {"metrics", digest_metrics(report)},
      {"times", time_names(report)},
      {"passes", pass_names(report)},
      {"extra",
       {{{"name", "lights"}, {"unit", ""}, {"words", "lights that were made"}},
        {{"name", "empty"}, {"unit", ""}, {"words", "of them without flux"}},
        {{"name", "memory_bytes"}, {"unit", "B"}, {"words", "memory of the method's own buffers"}},
        {{"name", "flux"}, {"unit", ""}, {"words", "power of the lights over that of the RSM"}},
        {{"name", "bias"}, {"unit", ""}, {"words", "energy of the image over the reference's, less 1"}}}},
      {"groups", groups.list},
      {"cases", digest_cases(report, groups.of_case)},
      {"budgets", std::move(answers.budgets)},
      {"knobs", std::move(answers.knobs)},
      {"temporal", digest_temporal(report)},
      {"claims", digest_claims(report)}};
}

}  // namespace vsglbench
