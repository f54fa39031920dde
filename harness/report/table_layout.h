// What a report's table says, before it is text.
#pragma once

#include "report/table.h"

namespace vsglbench {

using TableCells = std::vector<std::string>;

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
};

// Throws as terminal_table() does.
TableLayout table_of(const Report& report, const TableOptions& options);

}  // namespace vsglbench
