#include "papers/side_by_side.h"

#include <algorithm>

#include "base/error.h"
#include "papers/measured_table.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

std::string number(double value) {
  return value >= 1000 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

// "H200" of "NVIDIA H200", as far as a column's head needs it.
std::string device_of(const Report& report) {
  return report.device.name.substr(0, report.device.name.find(" ("));
}

MeasuredTable table_in(const Exhibit& exhibit, const std::string& scene, const MeasuredReport& m) {
  for (MeasuredTable& table : tables_of(m.report, exhibit)) {
    if (table.scene == scene) return std::move(table);
  }
  throw fail(ErrorKind::usage, "{}: has not all columns of {} for scene '{}'", m.link, exhibit.name, scene);
}

// The sum of the first column that has one.
template <class Value>
double first_sum(const std::vector<MeasuredRow>& rows, Value value) {
  const auto sum = std::ranges::find_if(rows, &MeasuredRow::sum);
  return sum == rows.end() ? 0 : value(*sum);
}

std::string cell(const std::string& text, bool sum, double value, double first) {
  return sum && first > 0 ? fmt::format("**{}** / {:.2f}", text, value / first) : text;
}

std::string source_of(const MeasuredReport& m) {
  const std::string text = fmt::format("{} of {}, commit {}", device_of(m.report),
                                       m.report.created.substr(0, 10), m.report.git.commit.substr(0, 7));
  return m.link.empty() ? text : fmt::format("[{}]({})", text, m.link);
}

}  // namespace

std::string side_by_side(const Exhibit& exhibit, const std::string& scene,
                         const std::vector<MeasuredReport>& measured) {
  if (exhibit.table.empty() || exhibit.code_size)
    throw fail(ErrorKind::usage, "{} has no published times", exhibit.name);
  const auto published = [](const MeasuredRow& row) { return published_value(row.published); };
  const auto here = [](const MeasuredRow& row) { return row.value.value_or(0); };
  std::vector<MeasuredTable> tables;
  std::string out = fmt::format("| | | {}, published |", exhibit.table.front().machine),
              rule = "| --- | --- | ---: |";
  for (const MeasuredReport& m : measured) {
    tables.push_back(table_in(exhibit, scene, m));
    out += fmt::format(" {} |", device_of(m.report));
    rule += " ---: |";
  }
  out += "\n" + rule + "\n";
  const std::vector<MeasuredRow>& rows = tables.front().rows;
  for (size_t i = 0; i < rows.size(); ++i) {
    const bool new_column = i == 0 || rows[i].column != rows[i - 1].column;
    out += fmt::format("| {} | {} | {} |", new_column ? rows[i].column : "", rows[i].name,
                       cell(rows[i].published, rows[i].sum, published(rows[i]), first_sum(rows, published)));
    for (const MeasuredTable& table : tables) {
      const MeasuredRow& row = table.rows.at(i);
      out += fmt::format(
          " {} |",
          row.value ? cell(number(*row.value), row.sum, *row.value, first_sum(table.rows, here)) : "-");
    }
    out += "\n";
  }
  std::vector<std::string> sources;
  for (const MeasuredReport& m : measured) sources.push_back(source_of(m));
  return out + fmt::format("\n{}: {}, ms; of totals also how many times the first; scene {}: {}.\n",
                           exhibit.source, exhibit.title, scene, fmt::join(sources, ", "));
}

std::string published_table(const std::vector<std::string>& words, const fs::path& folder) {
  std::string scene;
  std::vector<MeasuredReport> measured;
  for (size_t i = 1; i < words.size(); ++i) {
    if (words[i].starts_with("scene=")) {
      scene = words[i].substr(6);
    } else {
      measured.push_back({words[i], read_report(folder / words[i])});
    }
  }
  if (scene.empty() || measured.empty())
    throw fail(ErrorKind::usage, "a published table needs scene=NAME and a report, after the exhibit's name");
  return side_by_side(select_exhibits(load_exhibits(), {words.at(0)}).front(), scene, measured);
}

}  // namespace vsglbench
