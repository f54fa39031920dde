// Columns of numbers as the page has them: reports/dashboard/src/data.ts, Estimates.
#pragma once

#include <optional>

#include "answer/point.h"
#include "base/json.h"

namespace vsglbench {

// Of `digits` significant digits, so that the page stays small; null for what is no finite number.
Json rounded(double value, int digits = 7);
Json rounded(const std::optional<double>& value, int digits = 7);

// {value[], lo[], hi[]}: one entry a case, null where it has none.
struct EstimateColumn {
  Json value = Json::array(), lo = Json::array(), hi = Json::array();
  void add(const std::optional<Estimate>& estimate, int digits = 7);
};
Json to_json(const EstimateColumn& column);

}  // namespace vsglbench
