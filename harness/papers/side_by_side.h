// A table of a paper beside what several devices gave of it, as Markdown.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "papers/exhibit.h"
#include "report/report.h"

namespace vsglbench {

struct MeasuredReport {
  std::string link;  // to the report, in the text below the table; empty: none
  Report report;
};

// Row by row what is published and what each report measured in `scene`, in ms; of the sums also how many
// times the first column's each is. Throws Error(usage) for a scene that a report doesn't have all columns
// of.
std::string side_by_side(const Exhibit& exhibit, const std::string& scene,
                         const std::vector<MeasuredReport>& measured);

// By the words EXHIBIT scene=NAME REPORT..., paths relative to `folder`, as table_fill.h wants it. Throws
// Error(usage).
std::string published_table(const std::vector<std::string>& words, const std::filesystem::path& folder);

}  // namespace vsglbench
