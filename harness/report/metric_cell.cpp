#include "report/metric_cell.h"

namespace vsglbench {

std::string metric_cell(const MetricResult& metric, double scale, const char* format,
                        std::optional<double> floor) {
  if (!metric.value) return metric.empty() ? "not measured" : "undefined";
  const auto number = [&](double v) { return fmt::format(fmt::runtime(format), v * scale); };
  if (metric.heavy_tailed) {
    return fmt::format("{} [{} … {}]", number(*metric.median), number(*metric.least),
                       number(*metric.largest));
  }
  const std::string text = number(*metric.value);
  if (floor && *metric.value <= *floor) return text + " ≤ floor " + number(*floor);
  return metric.ci95 ? text + " ± " + significant(0.5 * metric.ci95->width() * scale, 2) : text;
}

std::string significant(double v, int digits) {
  const std::string text = fmt::format("{:.{}g}", v, digits);
  return text.find("e+") == std::string::npos ? text : fmt::format("{:.0f}", v);
}

}  // namespace vsglbench
