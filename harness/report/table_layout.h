// What a report's table says, before it is text.
#pragma once

#include "report/columns.h"
#include "report/table.h"

namespace vsglbench {

using TableCells = std::vector<std::string>;

inline constexpr const char* kFloorRow = "noise floor";  // the label of a scene's last row

// A row's numbers, or why there are none.
struct TableLine {
  std::string scene;  // empty where scenes stand across
  std::string label;
  TableCells cells;  // after the label's
  std::string message;
};

struct TableLayout {
  TableCells heads;  // the label's first
  std::vector<TableLine> lines;
  std::vector<std::string> notes;
  std::vector<std::string> columns;  // names, one a head but the first; empty where a part stands across
};

// Throws as terminal_table() does.
TableLayout table_of(const Report& report, const TableOptions& options);

// For a terminal so wide: columns that do not differ become a note (not those that were asked for by name),
// then those that don't fit, then names are shortened.
void fit_to_width(size_t width, bool named, TableLayout* table);

// Columns on a terminal: one for each sign of UTF-8 text.
size_t display_width(const std::string& text);

// The cases and columns of a table, for formats that have numbers in place of cells.
struct TableContents {
  std::vector<const CaseResult*> cases;
  std::vector<Column> columns;
};
TableContents contents_of(const Report& report, const TableOptions& options);
// A scene's first sound case, which others are compared with; there is one where `c` is sound.
const CaseResult& first_of_scene(const Report& report, const CaseResult& c);

}  // namespace vsglbench
