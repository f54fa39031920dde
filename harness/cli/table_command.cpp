#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/file.h"
#include "cli/command.h"
#include "cli/terminal.h"
#include "papers/side_by_side.h"
#include "report/table.h"
#include "report/table_fill.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

using Format = std::string (*)(const Report& report, const TableOptions& options);

const std::map<std::string, Format>& formats() {
  static const std::map<std::string, Format> known = {
      {"terminal", terminal_table}, {"markdown", markdown_table}, {"csv", csv_table}, {"latex", latex_table}};
  return known;
}

struct TableCommand {
  std::vector<fs::path> paths;
  TableOptions table;
  std::string format = "terminal";
  bool markdown = false, wide = false, fill = false, check = false;
};

void print(const TableCommand& command) {
  TableOptions options = command.table;
  if (!command.wide) options.width = terminal_width();
  const Format write = formats().at(command.markdown ? "markdown" : command.format);
  for (const fs::path& path : command.paths) fmt::print("{}", write(read_report_at(path), options));
}

// Writes what differs, or with `check` only says where.
void fill(const TableCommand& command) {
  std::vector<std::string> other;  // "README.md:70"
  size_t tables = 0;
  const auto files = files_with_tables(command.paths);
  for (const fs::path& file : files) {
    const std::string before = read_text(file);
    const FilledText filled = fill_tables(file, before, published_table);
    tables += filled.tables;
    const size_t line = first_other_line(before, filled.text);
    if (line == 0) continue;
    other.push_back(fmt::format("{}:{}", file.string(), line));
    if (!command.check) write_text(file, filled.text);
  }
  if (tables == 0)
    throw fail(ErrorKind::usage, "no Markdown file there holds a table; see vsglbench table --help");
  if (command.check && !other.empty()) {
    throw fail(
        ErrorKind::case_failed, "{}: not what its report says{}; 'vsglbench table --fill' writes it",
        other.front(),
        other.size() > 1 ? fmt::format(", nor {}", fmt::join(other.begin() + 1, other.end(), ", ")) : "");
  }
  fmt::print(
      "{} tables in {} files: {}\n", tables, files.size(),
      other.empty() ? "as their reports say" : "written anew: " + fmt::format("{}", fmt::join(other, ", ")));
}

void run(const TableCommand& command) {
  if (command.check && !command.fill) throw fail(ErrorKind::usage, "--check is of --fill; give both");
  if (command.fill &&
      (command.markdown || command.format != "terminal" || !command.table.sort.empty() ||
       !command.table.columns.empty() || !command.table.only.empty() || !command.table.across.empty()))
    throw fail(ErrorKind::usage, "with --fill the marker of each table names its columns; give them there");
  command.fill ? fill(command) : print(command);
}

}  // namespace

void add_table_command(CLI::App& app) {
  auto options = std::make_shared<TableCommand>();
  CLI::App* command =
      app.add_subcommand("table", "a report as a table; tables in Markdown files from reports");
  command->footer(
      "With --fill the paths are Markdown files, or folders of them, in which a table stands between the "
      "lines\n"
      "  <!-- table REPORT columns=smape,rmse across=method only=*/mfis/* -->\n"
      "  <!-- end of table -->\n"
      "REPORT relative to the file, the rest as the options here. <!-- published EXHIBIT scene=NAME "
      "REPORT... "
      "--> begins a\npaper's table with what each report has beside it; EXHIBIT as of `reproduce`.\n"
      "Example: vsglbench table reports/quick-lavapipe/report.json --columns smape,method --across method");
  command
      ->add_option("paths", options->paths,
                   "report.json, or its folder; with --fill Markdown files or folders")
      ->required();
  command
      ->add_option("--columns", options->table.columns,
                   "names, separated by ',' (default: all that a case has a number for)")
      ->delimiter(',');
  command->add_option("--only", options->table.only, "only the cases whose id matches one of these globs")
      ->allow_extra_args(false);
  command->add_option("--across", options->table.across,
                      "method, scene or a key of the ids, such as N: its values stand across");
  command->add_option("--sort", options->table.sort,
                      "a column's name: within each scene the least first; -COLUMN: the largest first");
  command
      ->add_option("--format", options->format,
                   "terminal, markdown, csv (numbers and intervals) or latex (booktabs)")
      ->check(CLI::IsMember(formats()))
      ->capture_default_str();
  command->add_flag("--markdown", options->markdown, "as --format markdown");
  command->add_flag(
      "--wide", options->wide,
      "every column in full; without it a table fits the terminal, or $COLUMNS, and says what it left out");
  command->add_flag("--fill", options->fill, "fill the tables of Markdown files");
  command->add_flag("--check", options->check,
                    "with --fill: write nothing; exit code 1 when a table differs");
  command->callback([=] { run(*options); });
}

}  // namespace vsglbench
