#include "dashboard/columns.h"

#include <cmath>
#include <cstdlib>

namespace vsglbench {

Json rounded(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
}

Json rounded(const std::optional<double>& value, int digits) {
  return value ? rounded(*value, digits) : Json(nullptr);
}

void EstimateColumn::add(const std::optional<Estimate>& estimate, int digits) {
  value.push_back(estimate ? rounded(estimate->value, digits) : nullptr);
  lo.push_back(estimate ? rounded(estimate->ci95.lo, digits) : nullptr);
  hi.push_back(estimate ? rounded(estimate->ci95.hi, digits) : nullptr);
}

Json to_json(const EstimateColumn& column) {
  return {{"value", column.value}, {"lo", column.lo}, {"hi", column.hi}};
}

}  // namespace vsglbench
