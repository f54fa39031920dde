#include "papers/measured_table.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <set>

#include "base/error.h"
#include "report/case_names.h"

namespace vsglbench {
namespace {

double mean(const std::vector<double>& samples) {
  return std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
}

bool is_wanted(const PassTiming& pass, const std::vector<std::string>& globs) {
  return std::ranges::any_of(globs,
                             [&](const std::string& glob) { return matches_glob(pass.pass.name(), glob); });
}

MeasuredRow row_of(const CaseResult& c, const PublishedColumn& column, const PublishedRow& published) {
  MeasuredRow row{
      .column = column.head, .name = published.name, .published = published.published, .sum = published.sum};
  std::vector<double> sums;
  for (const PassTiming& pass : c.passes) {
    if (!is_wanted(pass, published.passes)) continue;
    row.passes.push_back({pass.pass.name(), mean(pass.ms.samples)});
    sums.resize(pass.ms.samples.size(), 0);
    for (size_t i = 0; i < sums.size(); ++i) sums[i] += pass.ms.samples.at(i);
  }
  if (sums.empty()) return row;
  const Summary summary = summarize(sums);
  row.value = summary.median;
  row.ci95 = summary.ci95;
  row.mean = mean(sums);
  return row;
}

const CaseResult* case_of(const Report& report, const std::string& scene, const PublishedColumn& column) {
  const CaseResult* found = nullptr;
  for (const CaseResult& c : report.cases) {
    if (c.scene != scene || c.status != Status::ok || !matches_glob(c.id, column.cases)) continue;
    if (found)
      throw fail(ErrorKind::config, "column '{}' of the table matches two cases of {}: {} and {}",
                 column.head, scene, found->id, c.id);
    found = &c;
  }
  return found;
}

}  // namespace

double published_value(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw fail(ErrorKind::config, "the published value '{}' is no number", text);
  return value;
}

std::vector<MeasuredTable> tables_of(const Report& report, const Exhibit& exhibit) {
  std::vector<MeasuredTable> out;
  std::set<std::string> seen;
  for (const CaseResult& c : report.cases) {
    if (!seen.insert(c.scene).second) continue;
    MeasuredTable table{c.scene, "ms", {}};
    bool whole = true;
    for (const PublishedColumn& column : exhibit.table) {
      if (!matches_glob(c.scene, column.scene)) continue;
      const CaseResult* found = case_of(report, c.scene, column);
      whole = whole && found;
      if (!found) continue;
      for (const PublishedRow& row : column.rows) table.rows.push_back(row_of(*found, column, row));
    }
    if (whole && !table.rows.empty()) out.push_back(std::move(table));
  }
  return out;
}

MeasuredTable code_size_table_of(const Json& sizes, const Exhibit& exhibit) {
  MeasuredTable table{"", "", {}};
  for (const PublishedColumn& column : exhibit.table) {
    const auto size =
        std::ranges::find_if(sizes, [&](const Json& s) { return s.at("method") == column.cases; });
    for (const PublishedRow& published : column.rows) {
      MeasuredRow row{.column = column.head, .name = published.name, .published = published.published};
      if (size != sizes.end()) {
        double count = 0;
        for (const std::string& what : published.passes)
          count += size->at(Json::json_pointer(what)).get<double>();
        row.value = row.mean = count;
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace vsglbench
