#include "report/table.h"

#include <algorithm>
#include <sstream>

#include "base/printable.h"
#include "report/table_layout.h"

namespace vsglbench {
namespace {

std::string padding(size_t width, const std::string& text) {
  return std::string(width - std::min(width, display_width(text)), ' ');
}

// Broken at spaces where it is wider; 0: not.
std::string wrapped(const std::string& text, size_t width) {
  if (width == 0) return text + '\n';
  std::string out, line, word;
  std::istringstream words(text);
  while (words >> word) {
    if (!line.empty() && display_width(line) + 1 + display_width(word) > width) {
      out += line + '\n';
      line = "  ";
      line += word;
    } else {
      line += (line.empty() ? "" : " ") + word;
    }
  }
  return out + line + '\n';
}

// A scene's name stands once, above its rows.
std::vector<TableLine> with_scene_lines(const std::vector<TableLine>& lines) {
  std::vector<TableLine> out;
  std::string scene;
  for (const TableLine& line : lines) {
    if (line.scene != scene && !line.label.empty()) out.push_back({"", line.scene, {}, ""});
    scene = line.scene;
    out.push_back(line);
    if (!scene.empty()) out.back().label = line.label.empty() ? scene : "  " + line.label;
  }
  return out;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : printable(text)) out += c == '|' ? "\\|" : std::string(1, c);
  return out;
}

}  // namespace

std::string terminal_table(const Report& report, const TableOptions& options) {
  TableLayout table = table_of(report, options);
  if (options.width > 0) fit_to_width(options.width, !options.columns.empty(), &table);
  std::vector<TableCells> rows = {table.heads};
  std::vector<std::string> messages = {""};
  for (const TableLine& line : with_scene_lines(table.lines)) {
    rows.push_back({line.label});
    rows.back().insert(rows.back().end(), line.cells.begin(), line.cells.end());
    messages.push_back(printable(line.message));
  }
  for (TableCells& row : rows) std::ranges::transform(row, row.begin(), printable);
  std::vector<size_t> widths(table.heads.size());
  for (const TableCells& row : rows) {
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], display_width(row[i]));
  }
  std::string out;
  for (size_t r = 0; r < rows.size(); ++r) {
    const TableCells& row = rows[r];
    std::string line = row[0] + padding(widths[0], row[0]);
    if (!messages[r].empty()) line += "  " + messages[r];
    for (size_t i = 1; i < row.size(); ++i) line += "  " + padding(widths[i], row[i]) + row[i];
    out += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  for (const auto& note : table.notes) out += wrapped(printable(note), options.width);
  return out;
}

std::string markdown_table(const Report& report, const TableOptions& options) {
  const TableLayout table = table_of(report, options);
  std::string out = "|", rule = "|";
  for (size_t i = 0; i < table.heads.size(); ++i) {
    out += fmt::format(" {} |", escaped(table.heads[i]));
    rule += i == 0 ? " --- |" : " ---: |";
  }
  out += '\n' + rule + '\n';
  for (const TableLine& line : table.lines) {
    TableCells cells = line.cells;
    if (!line.message.empty()) cells.push_back(line.message);
    cells.resize(table.heads.size() - 1);
    const std::string gap = line.scene.empty() || line.label.empty() ? "" : " ";
    out += fmt::format("| {} |", escaped(line.scene + gap + line.label));
    for (const auto& cell : cells) out += cell.empty() ? " |" : fmt::format(" {} |", escaped(cell));
    out += '\n';
  }
  out += '\n';
  for (size_t i = 0; i < table.notes.size(); ++i)
    out += printable(table.notes[i]) + (i + 1 < table.notes.size() ? ";\n" : ".\n");
  return out;
}

}  // namespace vsglbench
