// Tests only: approximations.csv, the errors that the approximations have been measured to have. Where a
// formula changes on purpose, the failing test writes a table of what it measured, to stand in its place.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "base/csv.h"
#include "base/file.h"
#include "operation/approximations.h"

namespace vsglbench {

// oracle,case,error at each view angle
inline std::string to_csv(const std::string& oracle, const std::vector<ErrorRow>& rows) {
  std::string text;
  for (const ErrorRow& row : rows) {
    std::vector<std::string> cells = {oracle, row.name};
    for (const double e : row.error) cells.push_back(fmt::format("{:.4g}", e));
    text += csv_row(cells);
  }
  return text;
}

// Errors by case.
inline std::map<std::string, std::vector<double>> tabled_errors(const std::string& oracle) {
  std::map<std::string, std::vector<double>> table;
  for (const auto& row : parse_csv(read_text(data_root() / "harness/operation/approximations.csv"))) {
    if (row.at(0) != oracle) continue;
    for (size_t k = 2; k < row.size(); ++k) table[row.at(1)].push_back(std::stod(row[k]));
  }
  return table;
}

// What single precision and cubature leave open of value/integral = 1 + error.
inline constexpr double kTableTolerance = 3e-3;

// What differs from the table, a line a case; empty: nothing.
inline std::vector<std::string> differences_from_table(const std::string& oracle,
                                                       const std::vector<ErrorRow>& rows) {
  const auto table = tabled_errors(oracle);
  std::vector<std::string> out;
  for (const ErrorRow& row : rows) {
    const auto found = table.find(row.name);
    bool same = found != table.end() && found->second.size() == row.error.size();
    for (size_t k = 0; same && k < row.error.size(); ++k)
      same = std::abs(row.error[k] - found->second[k]) <= kTableTolerance * (1 + std::abs(found->second[k]));
    if (!same) {
      out.push_back(
          fmt::format("{}, {}: {:.4g}, not {:.4g}", oracle, row.name, fmt::join(row.error, " "),
                      fmt::join(found == table.end() ? std::vector<double>{} : found->second, " ")));
    }
  }
  if (rows.size() != table.size())
    out.push_back(fmt::format("{}: {} cases, {} in the table", oracle, rows.size(), table.size()));
  return out;
}

}  // namespace vsglbench
