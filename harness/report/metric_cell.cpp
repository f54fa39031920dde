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
  return metric.ci95 ? text + fmt::format(" ± {:.2g}", 0.5 * metric.ci95->width() * scale) : text;
}

}  // namespace vsglbench
