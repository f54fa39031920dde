// A table made to fit a terminal.
#include <algorithm>
#include <iterator>

#include "report/table_layout.h"

namespace vsglbench {
namespace {

constexpr size_t kGap = 2, kShortestName = 24;
// Columns that go first where there is no room; what is not named here goes before them, from the right.
constexpr const char* kKept[] = {"smape",          "method", "flicker", "generate", "rmse",
                                 "smape_lit",      "flip",   "bias",    "ratio",    "frame",
                                 "static_flicker", "detail", "rays",    "flux"};

// How much a column is worth, the less the more.
size_t rank_of(const TableLayout& table, size_t column) {
  if (table.columns.empty()) return column;
  const auto at = std::ranges::find(kKept, table.columns[column]);
  return static_cast<size_t>(at - std::begin(kKept));
}

// Of the names: rows stand indented below their scene.
size_t name_width(const TableLayout& table) {
  size_t width = display_width(table.heads.front());
  for (const TableLine& line : table.lines) {
    width = std::max({width, display_width(line.scene), 2 + display_width(line.label)});
  }
  return width;
}

size_t column_width(const TableLayout& table, size_t column) {
  size_t width = display_width(table.heads[column + 1]);
  for (const TableLine& line : table.lines) {
    if (column < line.cells.size()) width = std::max(width, display_width(line.cells[column]));
  }
  return width + kGap;
}

void erase_column(TableLayout* table, size_t column) {
  const auto at = static_cast<ptrdiff_t>(column);
  table->heads.erase(table->heads.begin() + at + 1);
  if (!table->columns.empty()) table->columns.erase(table->columns.begin() + at);
  for (TableLine& line : table->lines) {
    if (column < line.cells.size()) line.cells.erase(line.cells.begin() + at);
  }
}

// The cell that all rows of cases have; empty: they differ, or there are fewer than two.
std::string common_cell(const TableLayout& table, size_t column) {
  std::string cell;
  size_t rows = 0;
  for (const TableLine& line : table.lines) {
    if (column >= line.cells.size() || line.label == kFloorRow) continue;
    if (rows++ == 0) cell = line.cells[column];
    if (line.cells[column] != cell) return "";
  }
  return rows < 2 ? "" : cell;
}

void say_what_does_not_differ(TableLayout* table) {
  std::vector<std::string> same;
  for (size_t k = table->heads.size() - 1; k-- > 0;) {
    const std::string cell = common_cell(*table, k);
    if (cell.empty()) continue;
    same.insert(same.begin(), table->heads[k + 1] + " " + cell);
    erase_column(table, k);
  }
  if (!same.empty())
    table->notes.insert(table->notes.begin(),
                        fmt::format("the same in every row: {}", fmt::join(same, ", ")));
}

// The beginning and the end, where settings that tell cases apart often stand.
std::string shortened(const std::string& text, size_t width) {
  if (display_width(text) <= width) return text;
  std::vector<std::string> signs;
  for (const char c : text) {
    if ((c & 0xC0) != 0x80) signs.emplace_back();
    signs.back() += c;
  }
  const size_t head = width / 2, tail = width - 1 - head;
  std::string out;
  for (size_t i = 0; i < head; ++i) out += signs[i];
  out += "…";
  for (size_t i = signs.size() - tail; i < signs.size(); ++i) out += signs[i];
  return out;
}

}  // namespace

size_t display_width(const std::string& text) {
  return static_cast<size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

void fit_to_width(size_t width, bool named, TableLayout* table) {
  if (!named && !table->columns.empty()) say_what_does_not_differ(table);
  std::vector<size_t> widths;
  size_t numbers = 0;
  for (size_t k = 0; k + 1 < table->heads.size(); ++k) {
    widths.push_back(column_width(*table, k));
    numbers += widths.back();
  }
  // Long names may be shortened before a table is left with less than three columns.
  const size_t full = name_width(*table), shortest = std::min(full, kShortestName);
  std::vector<std::string> left_out;
  while (widths.size() > 1 && (widths.size() > 3 ? full : shortest) + numbers > width) {
    size_t worst = 0;
    for (size_t k = 1; k < widths.size(); ++k) {
      if (rank_of(*table, k) >= rank_of(*table, worst)) worst = k;
    }
    left_out.insert(left_out.begin(), table->heads[worst + 1]);
    numbers -= widths[worst];
    widths.erase(widths.begin() + static_cast<ptrdiff_t>(worst));
    erase_column(table, worst);
  }
  if (full + numbers > width) {
    const size_t room = std::max(shortest, width - std::min(width, numbers));
    for (TableLine& line : table->lines) {
      line.label = shortened(line.label, room - 2);
      line.scene = shortened(line.scene, room);
    }
  }
  if (!left_out.empty())
    table->notes.insert(table->notes.begin(),
                        fmt::format("left out, as {} columns have no room for them: {}; --wide shows them",
                                    width, fmt::join(left_out, ", ")));
}

}  // namespace vsglbench
