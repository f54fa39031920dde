#include "report/export.h"

#include <array>

#include "base/error.h"
#include "base/nearest.h"
#include "report/noise.h"

namespace vsglbench {
namespace {

struct Measured {
  const char *name, *unit;
  double value = 0, lower = 0, upper = 0;
};

struct ErrorField {
  const char *name, *unit;
  MetricResult Accuracy::*result;
};
constexpr std::array<ErrorField, 3> kErrors = {
    {{"smape", "%", &Accuracy::smape}, {"rmse", "W/m2/sr", &Accuracy::rmse}, {"flip", "1", &Accuracy::flip}}};

// All of a case that is better when smaller. Bias has a sign and is not.
std::vector<Measured> measured(const CaseResult& c) {
  std::vector<Measured> out;
  for (const char* time : {"method", "generate", "frame"}) {
    if (const auto ms = time_of(c, time)) out.push_back({time, "ms", ms->median, ms->ci95.lo, ms->ci95.hi});
  }
  if (!c.accuracy) return out;
  for (const ErrorField& f : kErrors) {
    const MetricResult& m = (*c.accuracy).*f.result;
    if (!m.value) continue;
    const Interval i = m.ci95.value_or(Interval{*m.value, *m.value});
    out.push_back({f.name, f.unit, *m.value, i.lo, i.hi});
  }
  return out;
}

Json bencher(const Report& report) {
  Json out = Json::object();
  for (const CaseResult& c : report.cases) {
    if (c.status != Status::ok) continue;
    Json measures = Json::object();
    for (const Measured& m : measured(c)) {
      const bool time = std::string(m.unit) == "ms";
      const double scale = time ? 1e6 : 1;  // ns
      const std::string name = !time                             ? m.name
                               : std::string(m.name) == "method" ? "latency"
                                                                 : std::string(m.name) + "-latency";
      measures[name] = {
          {"value", scale * m.value}, {"lower_value", scale * m.lower}, {"upper_value", scale * m.upper}};
    }
    out[c.id] = measures;
  }
  return out;
}

Json github_action(const Report& report) {
  Json out = Json::array();
  for (const CaseResult& c : report.cases) {
    if (c.status != Status::ok) continue;
    for (const Measured& m : measured(c)) {
      if (std::string(m.unit) != "ms" && std::string(m.unit) != "%") continue;
      out.push_back({{"name", c.id + " " + m.name},
                     {"unit", m.unit},
                     {"value", m.value},
                     {"range", fmt::format("{:.3g}", 0.5 * (m.upper - m.lower))}});
    }
  }
  return out;
}

Json google_benchmark(const Report& report) {
  Json runs = Json::array();
  for (const CaseResult& c : report.cases) {
    const auto ms = c.status == Status::ok ? time_of(c, "method") : std::nullopt;
    const auto generate = c.status == Status::ok ? time_of(c, "generate") : std::nullopt;
    if (!ms && !generate) continue;
    const Summary& time = ms ? *ms : *generate;
    Json run = {{"name", c.id},
                {"run_name", c.id},
                {"run_type", "iteration"},
                {"repetitions", 1},
                {"repetition_index", 0},
                {"threads", 1},
                {"iterations", time.samples.size()},
                {"real_time", time.median},
                {"cpu_time", time.median},
                {"time_unit", "ms"}};
    for (const Measured& m : measured(c)) run[m.name] = m.value;  // user counters
    runs.push_back(std::move(run));
  }
  return {{"context",
           {{"date", report.created},
            {"executable", "vsglbench"},
            {"host_name", report.device.name},
            {"num_cpus", report.host.cores},
            {"library_build_type", "release"}}},
          {"benchmarks", runs}};
}

struct Format {
  const char* name;
  Json (*write)(const Report&);
};
constexpr std::array<Format, 3> kFormats = {
    {{"bencher", bencher}, {"github-action", github_action}, {"google-benchmark", google_benchmark}}};

}  // namespace

std::vector<std::string> export_formats() {
  std::vector<std::string> names;
  for (const Format& f : kFormats) names.push_back(f.name);
  return names;
}

Json export_report(const Report& report, const std::string& format) {
  for (const Format& f : kFormats) {
    if (format == f.name) return f.write(report);
  }
  const auto names = export_formats();
  throw fail(ErrorKind::usage, "no format is named '{}'; did you mean '{}'?", format,
             nearest_name(format, names));
}

}  // namespace vsglbench
