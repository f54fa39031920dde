#include "report/columns.h"

#include <algorithm>

#include "report/metric_cell.h"
#include "report/noise.h"

namespace vsglbench {

std::string range_of(const std::vector<double>& values) {
  if (values.empty()) return "";
  const auto [least, most] = std::ranges::minmax(values);
  const std::string text = significant(least, 2), other = significant(most, 2);
  return text == other ? text : text + " … " + other;
}

namespace {

using Floor = std::optional<double> (*)(const ReferenceInfo&);

// --- errors ---

std::string number_of(const MetricResult& metric, double scale, const char* format) {
  if (!metric.value) return "undefined";
  const double value = metric.heavy_tailed ? *metric.median : *metric.value;
  return fmt::format(fmt::runtime(format), value * scale);
}

std::string floors_of(const Report& report, const std::string& scene, double scale, Floor floor) {
  std::vector<double> all;
  for (const CaseResult& c : report.cases) {
    if (c.scene != scene || !c.accuracy) continue;
    if (const auto value = floor(c.accuracy->reference)) all.push_back(*value * scale);
  }
  return range_of(all);
}

Column error_column(const char* name, const char* head, Metric which, MetricResult Accuracy::*metric,
                    double scale, const char* format, Floor floor) {
  Column column{name, head, {}, {}, {}, {}, {}};
  column.value = [=](const CaseResult& c, const CaseResult&) -> std::optional<double> {
    if (!c.accuracy) return std::nullopt;
    const MetricResult m = judged(*c.accuracy.*metric, which, c.seeds);
    const auto& v = m.heavy_tailed ? m.median : m.value;
    return v ? std::optional(*v * scale) : std::nullopt;
  };
  column.interval = [=](const CaseResult& c, const CaseResult&) -> std::optional<Interval> {
    if (!c.accuracy) return std::nullopt;
    const MetricResult m = judged(*c.accuracy.*metric, which, c.seeds);
    if (m.heavy_tailed) return Interval{*m.least * scale, *m.largest * scale};
    return m.ci95 ? std::optional(Interval{m.ci95->lo * scale, m.ci95->hi * scale}) : std::nullopt;
  };
  column.cell = [=](const CaseResult& c, const CaseResult&) {
    if (!c.accuracy || (*c.accuracy.*metric).empty()) return std::string();  // a report of old has fewer
    return metric_cell(judged(*c.accuracy.*metric, which, c.seeds), scale, format,
                       floor(c.accuracy->reference));
  };
  column.number = [=](const CaseResult& c, const CaseResult&) {
    const bool known = c.accuracy && !(*c.accuracy.*metric).empty();
    return known ? number_of(judged(*c.accuracy.*metric, which, c.seeds), scale, format) : "";
  };
  column.floor = [=](const Report& report, const std::string& scene) {
    return floors_of(report, scene, scale, floor);
  };
  return column;
}

std::optional<double> unknown_floor(const ReferenceInfo&) { return std::nullopt; }

// Σ light power / Σ texel power, mean over seeds.
Column flux_column() {
  Column column{"flux", "flux", {}, {}, {}, {}, {}};
  column.value = [](const CaseResult& c, const CaseResult&) {
    return c.generate && c.generate->flux ? std::optional(c.generate->flux->value) : std::nullopt;
  };
  column.interval = [](const CaseResult& c, const CaseResult&) {
    return c.generate && c.generate->flux ? c.generate->flux->ci95 : std::nullopt;
  };
  column.number = [](const CaseResult& c, const CaseResult&) {
    return c.generate && c.generate->flux ? fmt::format("{:.3f}", c.generate->flux->value) : std::string();
  };
  column.cell = column.number;
  column.floor = [](const Report&, const std::string&) { return std::string(); };
  return column;
}

// --- flicker ---

struct Moving {
  double value;
  std::optional<Interval> ci95;
};

std::optional<Moving> derivative_of(const Temporal& t) {
  return Moving{t.derivative.value, t.derivative.ci95};
}
std::optional<Moving> static_of(const Temporal& t) {
  return t.still ? std::optional(Moving{t.still->value, t.still->ci95}) : std::nullopt;
}
std::optional<Moving> gain_of(const Temporal& t) {
  return t.detail ? std::optional(Moving{t.detail->gain, std::nullopt}) : std::nullopt;
}
std::optional<Moving> detail_of(const Temporal& t) {
  return t.detail ? std::optional(Moving{t.detail->value, t.detail->ci95}) : std::nullopt;
}

Column temporal_column(const char* name, const char* head, std::optional<Moving> (*of)(const Temporal& t)) {
  Column column{name, head, {}, {}, {}, {}, {}};
  const auto found = [=](const CaseResult& c) { return c.temporal ? of(*c.temporal) : std::nullopt; };
  column.value = [=](const CaseResult& c, const CaseResult&) {
    const auto v = found(c);
    return v ? std::optional(v->value) : std::nullopt;
  };
  column.interval = [=](const CaseResult& c, const CaseResult&) {
    const auto v = found(c);
    return v ? v->ci95 : std::nullopt;
  };
  column.number = [=](const CaseResult& c, const CaseResult&) {
    const auto v = found(c);
    return v ? fmt::format("{:.4f}", v->value) : std::string();
  };
  column.cell = [=](const CaseResult& c, const CaseResult&) {
    const auto v = found(c);
    if (!v) return std::string();
    const std::string half = v->ci95 ? fmt::format(" ± {:.2g}", 0.5 * v->ci95->width()) : "";
    return fmt::format("{:.4f}{}", v->value, half);
  };
  column.floor = [=](const Report& report, const std::string& scene) {
    std::vector<double> all;
    for (const CaseResult& c : report.cases)
      if (c.scene == scene && c.temporal && of == derivative_of) all.push_back(c.temporal->noise_floor);
    return range_of(all);
  };
  return column;
}

// --- times ---

std::string ms(double value) {
  return value < 100 ? fmt::format("{:.2f}", value) : fmt::format("{:.0f}", value);
}

std::function<std::string(const Report&, const std::string&)> noise_floor_of(const std::string& time) {
  return [=](const Report& report, const std::string& scene) {
    const TimeNoise* noise = noise_of(report, scene, time);
    return noise ? percent(noise->noise_floor) : "";
  };
}

// `name` is that of a time and of its noise. With the median's 95 % interval where `interval` says so.
Column time_column(const char* name, const char* head, bool interval = false) {
  Column column{name, head, {}, {}, {}, {}, noise_floor_of(name)};
  column.value = [=](const CaseResult& c, const CaseResult&) {
    const auto time = time_of(c, name);
    return time ? std::optional(time->median) : std::nullopt;
  };
  column.interval = [=](const CaseResult& c, const CaseResult&) {
    const auto time = time_of(c, name);
    return time ? std::optional(time->ci95) : std::nullopt;
  };
  column.number = [=](const CaseResult& c, const CaseResult&) {
    const auto time = time_of(c, name);
    return time ? ms(time->median) : "";
  };
  column.cell = [=](const CaseResult& c, const CaseResult&) {
    const auto time = time_of(c, name);
    if (!time) return std::string();
    const size_t frames = time->samples.size();
    if (interval && frames < 3)  // of so few there is no interval to speak of
      return fmt::format("{} ({} frame{})", ms(time->median), frames, frames == 1 ? "" : "s");
    return interval ? fmt::format("{} [{}, {}]", ms(time->median), ms(time->ci95.lo), ms(time->ci95.hi))
                    : ms(time->median);
  };
  return column;
}

// The ratio of light generation to that of the scene's first sound case.
std::optional<Ratio> ratio_to(const CaseResult& c, const CaseResult& first) {
  const Summary &a = c.generate->total, &b = first.generate->total;
  if (a.min <= 0 || b.min <= 0) return std::nullopt;  // the device's clock saw no time pass
  return median_ratio(a.samples, b.samples);
}

Column ratio_column() {
  Column column{"ratio", "x first [95 %]", {}, {}, {}, {}, noise_floor_of("generate")};
  column.value = [](const CaseResult& c, const CaseResult& first) {
    const auto r = c.generate ? ratio_to(c, first) : std::nullopt;
    return r ? std::optional(r->value) : std::nullopt;
  };
  column.interval = [](const CaseResult& c, const CaseResult& first) {
    const auto r = c.generate ? ratio_to(c, first) : std::nullopt;
    return r ? std::optional(r->ci95) : std::nullopt;
  };
  column.cell = [](const CaseResult& c, const CaseResult& first) -> std::string {
    if (!c.generate) return "";
    if (c.id == first.id) return "1";
    const auto r = ratio_to(c, first);
    return r ? fmt::format("{:.3f} [{:.3f}, {:.3f}]", r->value, r->ci95.lo, r->ci95.hi) : "undefined";
  };
  column.number = [](const CaseResult& c, const CaseResult& first) -> std::string {
    if (!c.generate) return "";
    const auto r = ratio_to(c, first);
    return r ? fmt::format("{:.2f}", r->value) : "undefined";
  };
  return column;
}

Column on_request(Column column) {
  column.on_request = true;
  return column;
}

}  // namespace

const std::vector<Column>& frame_columns() {
  static const std::vector<Column> columns = {
      error_column("smape", "SMAPE %", Metric::smape, &Accuracy::smape, 1, "{:.2f}",
                   [](const ReferenceInfo& r) { return std::optional(r.noise_floor_smape); }),
      error_column("smape_lit", "SMAPE lit %", Metric::smape_lit, &Accuracy::smape_lit, 1, "{:.2f}",
                   [](const ReferenceInfo& r) { return r.noise_floor_smape_lit; }),
      error_column("rmse", "RMSE", Metric::rmse, &Accuracy::rmse, 1, "{:.4g}",
                   [](const ReferenceInfo& r) { return r.noise_floor_rmse; }),
      error_column("flip", "flip", Metric::flip, &Accuracy::flip, 1, "{:.4f}",
                   [](const ReferenceInfo& r) { return r.noise_floor_flip; }),
      error_column("bias", "bias %", Metric::bias, &Accuracy::bias, 100, "{:+.2f}", unknown_floor),
      flux_column(),
      temporal_column(kTemporalColumns[0], "flicker", derivative_of),
      temporal_column(kTemporalColumns[1], "static flicker", static_of),
      temporal_column(kTemporalColumns[2], "detail", detail_of),
      temporal_column(kTemporalColumns[3], "gain", gain_of),
      time_column("generate", "generate ms"),
      time_column("method", "method ms [95 %]", true),
      time_column("rays", "rays ms (host)"),
      time_column("frame", "frame ms"),
      on_request(time_column("fixed", "fixed ms")),
      on_request(time_column("importance", "importance ms")),
      on_request(time_column("visibility", "visibility ms")),
      on_request(time_column("shade", "shade ms")),
  };
  return columns;
}

const std::vector<Column>& generation_columns() {
  static const std::vector<Column> columns = {time_column("generate", "generate ms"),
                                              time_column("generate.gbuffer", "G-buffer ms"),
                                              time_column("generate.rsm", "RSM ms"), ratio_column()};
  return columns;
}

}  // namespace vsglbench
