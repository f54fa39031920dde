// What a claim's metric is of a case: a value a seed, or a time.
#include "answer/claim_values.h"

#include <algorithm>
#include <cmath>

#include "report/noise.h"

namespace vsglbench {
namespace {

constexpr std::string_view kTime = "time:", kPassTime = "time:pass:";

// Of how the seed's lights lie on the RSM; nothing where the method does not say.
template <class Part>
std::optional<double> part_value(const std::optional<Part>& part, double Part::*value) {
  return part ? std::optional((*part).*value) : std::nullopt;
}

std::optional<double> region_value(const RegionErrors& region, const std::string& metric) {
  if (metric == "region.rmse") return region.rmse;
  if (metric == "region.smape") return region.smape;
  if (metric == "region.detail") return region.detail;
  throw std::logic_error("no metric " + metric);
}

std::optional<double> seed_value(const SeedResult& s, const std::string& metric) {
  if (metric == "overlap") return part_value(s.coverage, &Coverage::overlap);
  if (metric == "gap") return part_value(s.coverage, &Coverage::gap);
  if (metric == "pdf_overlap") return s.coverage ? s.coverage->pdf_overlap : std::nullopt;
  if (metric == "pdf_gap") return s.coverage ? s.coverage->pdf_gap : std::nullopt;
  if (metric == "kernel_largest") return part_value(s.kernels, &KernelStats::largest);
  if (metric == "kernel_over") return part_value(s.kernels, &KernelStats::over);
  if (metric == "flip_p99") return s.errors.flip_p99;
  if (metric == "p99_9") return s.errors.p99_9;
  if (metric == "detail") return s.detail;
  if (metric == "spikes") return s.spikes;
  if (metric == "cancellation_rate") return s.cancellation_rate;
  if (metric.starts_with("region.")) return s.region ? region_value(*s.region, metric) : std::nullopt;
  for (const Metric m : kMetrics) {
    if (formula(m).name == metric) return s.errors.value(m);
  }
  throw std::logic_error("no metric " + metric);
}

// Shares of texels, or of the PDF in them.
bool is_of_texels(const std::string& metric) {
  return metric.ends_with("overlap") || metric.ends_with("gap");
}

// Texels that the lights lie on; 0: not known.
double texels_of(const CaseResult& c) {
  const auto side = c.parameters.find("rsm");
  return side != c.parameters.end() && side->is_number() ? std::pow(side->get<double>(), 2) : 0;
}

// What the metric is a share of: pixels, lights or texels. Nothing of what is not counted, or unknown.
std::optional<double> units_of(const CaseResult& c, const SeedResult& s, const std::string& metric) {
  double units = 0;
  if (metric == "spikes") units = static_cast<double>(s.errors.pixels);
  if (metric == "kernel_over" && c.generate) units = static_cast<double>(c.generate->lights);
  if (is_of_texels(metric)) units = texels_of(c);
  return units > 0 ? std::optional(units) : std::nullopt;
}

// By seed. Of the static flicker, which is one number for all seeds, how far each seed's image is from those
// of the others.
std::vector<double> temporal_values(const Temporal& t, const std::string& metric) {
  if (metric == "temporal.derivative") return t.derivative.values;
  if (metric == "temporal.static") return t.still ? t.still->series : std::vector<double>{};
  if (metric != "temporal.detail") throw std::logic_error("no metric " + metric);
  // Where one seed has no detail left there is no ratio, and those that have some would tell but half.
  if (!t.detail || std::ranges::any_of(t.detail->values, [](double v) { return v <= 0; })) return {};
  return t.detail->values;
}

std::map<uint64_t, double> temporal_logs(const CaseResult& c, const std::string& metric) {
  std::map<uint64_t, double> out;
  const auto values = c.temporal ? temporal_values(*c.temporal, metric) : std::vector<double>{};
  for (uint64_t seed = 0; seed < values.size(); ++seed) {
    if (values[seed] > 0) out[seed] = std::log(values[seed]);
  }
  if (metric == "temporal.static" && out.size() < 3) out.clear();
  return out;
}

}  // namespace

bool is_time(const std::string& metric) { return metric.starts_with(kTime); }

std::optional<std::string> pass_glob(const std::string& metric) {
  return metric.starts_with(kPassTime) ? std::optional(metric.substr(kPassTime.size())) : std::nullopt;
}

std::optional<Summary> claimed_time(const CaseResult& c, const std::string& metric) {
  if (const auto glob = pass_glob(metric)) return time_of_passes(c, *glob);
  return time_of(c, is_time(metric) ? metric.substr(kTime.size()) : "method");
}

double claimed_noise(const Report& report, const std::string& scene, const std::string& metric) {
  const auto glob = pass_glob(metric);
  const std::string column = glob              ? column_of_passes(report, scene, *glob)
                             : is_time(metric) ? metric.substr(kTime.size())
                                               : "method";
  const TimeNoise* known = noise_of(report, scene, column);
  return known ? known->noise_floor : 0;
}

bool is_temporal(const std::string& metric) { return metric.starts_with("temporal."); }

// Many images have no spike, most light sets no too large kernel, some no gap, and a share of 0 has no
// logarithm. Half a unit more on both sides moves counts of one or two towards each other and larger ones
// hardly; without it the very seeds that tell most would be left out.
std::map<uint64_t, double> logs_of(const CaseResult& c, const std::string& metric) {
  if (is_temporal(metric)) return temporal_logs(c, metric);
  std::map<uint64_t, double> out;
  for (const SeedResult& s : c.seeds) {
    const auto value = seed_value(s, metric);
    const auto units = units_of(c, s, metric);
    const double half_unit = units ? 0.5 / *units : 0;
    if (value && *value + half_unit > 0) out[s.seed] = std::log(*value + half_unit);
  }
  return out;
}

bool has_none(const CaseResult& c, const std::string& metric) {
  if (is_time(metric) || is_temporal(metric)) return false;
  return std::ranges::all_of(
      c.seeds, [&](const SeedResult& s) { return units_of(c, s, metric) && seed_value(s, metric) == 0.0; });
}

}  // namespace vsglbench
