// Tables of reports in Markdown files, kept as the reports say. A table stands between two lines:
//
//   <!-- table reports/quick-lavapipe/report.json columns=smape,rmse across=method only=*/mfis/* -->
//   <!-- end of table -->
//
// The path is relative to the file; the words after it are TableOptions, `only` any number of times. A
// published table beside what was measured begins with
//
//   <!-- published mfis16-tab1 scene=colonnade reports/h200/mfis16-table1.report.json -->
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace vsglbench {

struct FilledText {
  std::string text;
  size_t tables = 0;
};

// The table of a marker `published` by the words of it; paths among them are relative to `folder`.
using PublishedTable =
    std::function<std::string(const std::vector<std::string>& words, const std::filesystem::path& folder)>;

// `text` of the Markdown file at `path`, every table made anew. Throws Error(usage) "FILE:LINE: ..." for a
// marker that is wrong or has no end, and for a report that gives no such table.
FilledText fill_tables(const std::filesystem::path& path, const std::string& text,
                       const PublishedTable& published = {});

// The Markdown files among `paths` that hold a table; of a folder all below it but in hidden folders, build/
// and out/. Throws Error(usage) for a path that is not there.
std::vector<std::filesystem::path> files_with_tables(const std::vector<std::filesystem::path>& paths);

// From 1; 0: the texts are equal.
size_t first_other_line(const std::string& a, const std::string& b);

}  // namespace vsglbench
