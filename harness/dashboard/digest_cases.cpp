// Cases as columns.
#include <algorithm>
#include <cmath>
#include <map>

#include "answer/point.h"
#include "dashboard/columns.h"
#include "dashboard/digest.h"
#include "report/case_names.h"
#include "report/noise.h"

namespace vsglbench {
namespace {

constexpr double kIntervalSteps =
    1e4;  // to a median: ends of the intervals of passes, of which there are many

// Names of cases that are told apart from their neighbours alone: of one scene and group.
std::vector<std::string> labels(const Report& report, const std::vector<int>& groups) {
  std::map<std::pair<std::string, int>, std::vector<const CaseResult*>> neighbours;
  for (size_t i = 0; i < report.cases.size(); ++i) {
    neighbours[{report.cases[i].scene, groups[i]}].push_back(&report.cases[i]);
  }
  std::map<const CaseResult*, std::string> names;
  for (const auto& [key, cases] : neighbours) {
    const CaseNames by(cases);
    for (const CaseResult* c : cases) names[c] = by.label(*c);
  }
  std::vector<std::string> out;
  for (const CaseResult& c : report.cases) out.push_back(names.at(&c));
  return out;
}

Json parameter_columns(const Report& report) {
  std::vector<std::string> keys;
  for (const CaseResult& c : report.cases) {
    for (const auto& [key, value] : c.parameters.items()) {
      if (std::ranges::count(keys, key) == 0) keys.push_back(key);
    }
  }
  Json out = Json::object();
  for (const std::string& key : keys) {
    Json column = Json::array();
    for (const CaseResult& c : report.cases) {
      const Json value = c.parameters.value(key, Json());
      const bool plain = value.is_null() || value.is_string() || value.is_number();
      column.push_back(plain ? value : Json(value.dump()));
    }
    out[key] = std::move(column);
  }
  return out;
}

Json time_columns_of(const Report& report) {
  Json out = Json::object();
  for (const std::string& name : time_columns()) {
    EstimateColumn column;
    bool any = false;
    for (const CaseResult& c : report.cases) {
      std::optional<Summary> ms = time_of(c, name);
      if (!ms && name == "method" && !c.passes.empty()) ms = method_time(c.passes);  // a report of old
      any = any || ms;
      column.add(ms ? std::optional(Estimate{ms->median, ms->ci95}) : std::nullopt);
    }
    if (any) out[name] = to_json(column);
  }
  return out;
}

Json seed_values(const CaseResult& c, const std::string& metric) {
  Json out = Json::array();
  for (const double v : seeds_of(c, metric)) out.push_back(rounded(v, 9));
  return out.empty() ? Json(nullptr) : out;
}

Json error_columns(const Report& report) {
  Json out = Json::object();
  for (const Json& metric : digest_metrics(report)) {
    const auto name = metric.at("name").get<std::string>();
    EstimateColumn column;
    Json heavy = Json::array(), seeds = Json::array();
    for (const CaseResult& c : report.cases) {
      const std::optional<Estimate> error = error_of(c, name);
      column.add(error);
      heavy.push_back(error && is_heavy_tailed(c, name) ? 1 : 0);
      seeds.push_back(error ? seed_values(c, name) : Json(nullptr));
    }
    Json json = to_json(column);
    json["heavy"] = std::move(heavy);
    json["seeds"] = std::move(seeds);
    out[name] = std::move(json);
  }
  return out;
}

Json extra_columns(const Report& report) {
  Json lights = Json::array(), empty = Json::array(), memory = Json::array(), flux = Json::array(),
       bias = Json::array();
  for (const CaseResult& c : report.cases) {
    lights.push_back(c.generate ? Json(c.generate->lights) : Json(nullptr));
    empty.push_back(c.generate ? Json(c.generate->empty) : Json(nullptr));
    memory.push_back(c.generate ? Json(c.generate->memory_bytes) : Json(nullptr));
    flux.push_back(c.generate && c.generate->flux ? rounded(c.generate->flux->value) : Json(nullptr));
    bias.push_back(c.accuracy ? rounded(c.accuracy->bias.value) : Json(nullptr));
  }
  return {{"lights", lights}, {"empty", empty}, {"memory_bytes", memory}, {"flux", flux}, {"bias", bias}};
}

// How far an end of an interval is from its median.
int64_t interval_steps(double end, double median) {
  return median > 0 ? std::llround(kIntervalSteps * std::abs(end / median - 1)) : 0;
}

Json pass_rows(const Report& report) {
  std::map<std::string, size_t> place;
  for (const std::string& name : pass_names(report)) place.emplace(name, place.size());
  Json out = Json::array();
  for (const CaseResult& c : report.cases) {
    Json pass = Json::array(), ms = Json::array(), below = Json::array(), above = Json::array();
    for (const PassTiming& p : c.passes) {
      pass.push_back(place.at(p.pass.name()));
      ms.push_back(rounded(p.ms.median));
      below.push_back(interval_steps(p.ms.ci95.lo, p.ms.median));
      above.push_back(interval_steps(p.ms.ci95.hi, p.ms.median));
    }
    out.push_back({{"pass", std::move(pass)},
                   {"ms", std::move(ms)},
                   {"below", std::move(below)},
                   {"above", std::move(above)}});
  }
  return out;
}

}  // namespace

Json digest_metrics(const Report& report) {
  Json out = Json::array();
  for (const std::string& name : error_names()) {
    const bool has = std::ranges::any_of(
        report.cases, [&](const CaseResult& c) { return c.accuracy && metric_of(*c.accuracy, name); });
    if (has) out.push_back({{"name", name}, {"title", metric_title(name)}, {"unit", metric_unit(name)}});
  }
  return out;
}

Json digest_cases(const Report& report, const std::vector<int>& groups) {
  const std::vector<std::string> methods = methods_of(report);
  Json id = Json::array(), scene = Json::array(), method = Json::array(), status = Json::array(),
       message = Json::array();
  for (const CaseResult& c : report.cases) {
    id.push_back(c.id);
    scene.push_back(scene_index(report, c.scene));
    method.push_back(std::ranges::find(methods, c.method) - methods.begin());
    status.push_back(std::string(name(c.status)));
    message.push_back(c.error ? c.error->message : "");
  }
  return {{"id", std::move(id)},
          {"label", labels(report, groups)},
          {"group", groups},
          {"scene", std::move(scene)},
          {"method", std::move(method)},
          {"status", std::move(status)},
          {"message", std::move(message)},
          {"parameters", parameter_columns(report)},
          {"times", time_columns_of(report)},
          {"errors", error_columns(report)},
          {"extra", extra_columns(report)},
          {"passes", pass_rows(report)}};
}

}  // namespace vsglbench
