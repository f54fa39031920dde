#include "report/table_fill.h"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "base/file.h"
#include "base/nearest.h"
#include "report/table.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr std::string_view kBegin = "<!-- table ", kPublished = "<!-- published ",
                           kEnd = "<!-- end of table -->";

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

void set(const std::string& word, TableOptions* options) {
  const std::string key = word.substr(0, word.find('='));
  const std::string value = word.substr(std::min(key.size() + 1, word.size()));
  if (key == "columns") {
    options->columns = split(value, ',');
  } else if (key == "across") {
    options->across = value;
  } else if (key == "only") {
    options->only.push_back(value);
  } else {
    throw fail(ErrorKind::usage, "no option '{}' of a table{}", key,
               suggestion(key, {"columns", "across", "only"}));
  }
}

// `marker`: the whole line.
std::string table_for(const std::string& marker, const fs::path& folder, const PublishedTable& published) {
  const bool of_paper = marker.starts_with(kPublished);
  const size_t begin = of_paper ? kPublished.size() : kBegin.size();
  std::istringstream in(marker.substr(begin, marker.rfind("-->") - begin));
  const std::vector<std::string> words{std::istream_iterator<std::string>(in), {}};
  if (words.empty()) throw fail(ErrorKind::usage, "this table names no report");
  if (of_paper && !published) throw fail(ErrorKind::usage, "published tables are not known here");
  if (of_paper) return published(words, folder);
  TableOptions options;
  options.link = words[0];
  for (size_t i = 1; i < words.size(); ++i) set(words[i], &options);
  return markdown_table(read_report(folder / options.link), options);
}

bool begins_table(const std::string& line) {
  return line.starts_with(kBegin) || line.starts_with(kPublished);
}

bool is_skipped(const fs::path& folder) {
  const std::string name = folder.filename().string();
  return name.starts_with('.') || name == "build" || name == "out";
}

bool holds_table(const fs::path& file) {
  if (file.extension() != ".md") return false;
  const auto lines = split(read_text(file), '\n');
  return std::ranges::any_of(lines, begins_table);
}

}  // namespace

FilledText fill_tables(const fs::path& path, const std::string& text, const PublishedTable& published) {
  FilledText out;
  size_t number = 0, opened = 0;  // lines; `opened`: of the marker whose end is awaited
  const auto wrong = [&](size_t line, const std::string& what) {
    return fail(ErrorKind::usage, "{}:{}: {}", path.string(), line, what);
  };
  for (const std::string& line : split(text, '\n')) {
    ++number;
    const bool begins = begins_table(line), ends = line == kEnd;
    if (begins && opened) throw wrong(opened, "this table has no end; close it with " + std::string(kEnd));
    if (ends && !opened) throw wrong(number, "this table has no beginning");
    if (begins) {
      if (!line.ends_with("-->")) throw wrong(number, "the marker of a table must end in --> on its line");
      opened = number;
      out.tables++;
      try {
        out.text += line + "\n\n" + table_for(line, path.parent_path(), published) + "\n";
      } catch (const Error& e) {
        throw wrong(number, e.what());
      }
    }
    if (ends) opened = 0;
    if (!opened) out.text += line + "\n";
  }
  if (opened) throw wrong(opened, "this table has no end; close it with " + std::string(kEnd));
  return out;
}

std::vector<fs::path> files_with_tables(const std::vector<fs::path>& paths) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    if (!fs::exists(path)) throw fail(ErrorKind::usage, "{}: no such file or folder", path.string());
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    for (auto at = fs::recursive_directory_iterator(path); at != fs::end(at); ++at) {
      if (at->is_directory() && is_skipped(at->path())) at.disable_recursion_pending();
      if (at->is_regular_file() && holds_table(at->path())) files.push_back(at->path());
    }
  }
  std::ranges::sort(files);
  return files;
}

size_t first_other_line(const std::string& a, const std::string& b) {
  if (a == b) return 0;
  const auto at = std::ranges::mismatch(a, b).in1;
  return 1 + static_cast<size_t>(std::count(a.begin(), at, '\n'));
}

}  // namespace vsglbench
