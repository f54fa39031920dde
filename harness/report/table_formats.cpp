// Tables for other programs: CSV and LaTeX.
#include <algorithm>

#include "base/csv.h"
#include "base/printable.h"
#include "report/table_layout.h"

namespace vsglbench {
namespace {

std::string digits(const std::optional<double>& v) { return v ? fmt::format("{}", *v) : ""; }

std::string printable_row(TableCells cells) {
  std::ranges::transform(cells, cells.begin(), printable);
  return csv_row(cells);
}

std::string across_csv(const TableLayout& table) {
  std::string out = printable_row([&] {
    TableCells heads = {"scene"};
    heads.insert(heads.end(), table.heads.begin(), table.heads.end());
    return heads;
  }());
  for (const TableLine& line : table.lines) {
    TableCells cells = {line.scene, line.label};
    cells.insert(cells.end(), line.cells.begin(), line.cells.end());
    out += printable_row(cells);
  }
  return out;
}

std::string latex(const std::string& text) {
  std::string out;
  for (const char c : printable(text)) {
    switch (c) {
      case '\\':
        out += "\\textbackslash{}";
        break;
      case '~':
        out += "\\textasciitilde{}";
        break;
      case '^':
        out += "\\textasciicircum{}";
        break;
      case '#':
      case '$':
      case '%':
      case '&':
      case '_':
      case '{':
      case '}':
        out += '\\';
        out += c;
        break;
      default:
        out += c;
    }
  }
  for (const auto& [sign, command] :
       {std::pair("±", "$\\pm$"), std::pair("≤", "$\\le$"), std::pair("…", "\\ldots{}"),
        std::pair("×", "$\\times$"), std::pair("²", "$^2$")}) {
    for (size_t at; (at = out.find(sign)) != std::string::npos;)
      out.replace(at, std::string_view(sign).size(), command);
  }
  return out;
}

}  // namespace

std::string csv_table(const Report& report, const TableOptions& options) {
  if (!options.across.empty()) return across_csv(table_of(report, options));
  const TableContents contents = contents_of(report, options);
  TableCells heads = {"scene", "case", "method", "status"};
  for (const Column& column : contents.columns) {
    for (const char* end : {"", "_lo", "_hi"}) heads.push_back(column.name + end);
  }
  std::string out = printable_row(heads);
  for (const CaseResult* c : contents.cases) {
    TableCells cells = {c->scene, c->id, c->method, std::string(name(c->status))};
    for (const Column& column : contents.columns) {
      std::optional<double> value;
      std::optional<Interval> interval;
      if (c->status == Status::ok) {
        const CaseResult& first = first_of_scene(report, *c);
        value = column.value(*c, first);
        if (value) interval = column.interval(*c, first);
      }
      cells.push_back(digits(value));
      cells.push_back(interval ? fmt::format("{}", interval->lo) : "");
      cells.push_back(interval ? fmt::format("{}", interval->hi) : "");
    }
    out += printable_row(cells);
  }
  return out;
}

std::string latex_table(const Report& report, const TableOptions& options) {
  const TableLayout table = table_of(report, options);
  const size_t columns = table.heads.size();
  std::vector<std::string> heads;
  for (const std::string& head : table.heads) heads.push_back(latex(head));
  std::string out =
      "% \\usepackage{booktabs}\n\\begin{tabular}{l" + std::string(columns - 1, 'r') + "}\n\\toprule\n";
  out += fmt::format("{} \\\\\n", fmt::join(heads, " & "));
  std::string scene = "\n";  // of no line
  for (const TableLine& line : table.lines) {
    if (line.scene != scene) {
      out += "\\midrule\n";
      if (!line.scene.empty())
        out += fmt::format("\\multicolumn{{{}}}{{l}}{{{}}} \\\\\n", columns, latex(line.scene));
    }
    scene = line.scene;
    out += (scene.empty() ? "" : "\\quad ") + latex(line.label);
    if (!line.message.empty())
      out += fmt::format(" & \\multicolumn{{{}}}{{l}}{{{}}}", columns - 1, latex(line.message));
    for (const std::string& cell : line.cells) out += " & " + latex(cell);
    out += " \\\\\n";
  }
  out += "\\bottomrule\n\\end{tabular}\n";
  for (const std::string& note : table.notes) out += "% " + printable(note) + '\n';
  return out;
}

}  // namespace vsglbench
