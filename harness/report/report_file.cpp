#include <cmath>

#include "base/file.h"
#include "report/report.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

void require_finite(const Json& value, const std::string& at, const fs::path& path) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) {
    throw fail(ErrorKind::output, "{}: cannot be written: '{}' is {}", path.string(), at,
               value.get<double>());
  }
  if (value.is_object()) {
    for (const auto& [key, member] : value.items())
      require_finite(member, at.empty() ? key : at + "/" + key, path);
  } else if (value.is_array()) {
    for (size_t i = 0; i < value.size(); ++i) require_finite(value[i], fmt::format("{}/{}", at, i), path);
  }
}

bool is_flat(const Json& value) {
  for (const auto& item : value) {
    if (item.is_structured()) return false;
  }
  return true;
}

// Indented, but lists of plain values on one line each: a report holds thousands of samples.
void print(const Json& value, int depth, std::string& out) {
  if (!value.is_structured() || value.empty() || (value.is_array() && is_flat(value))) {
    out += value.dump();
    return;
  }
  out += value.is_object() ? "{" : "[";
  bool first = true;
  for (const auto& [key, item] : value.items()) {
    out += fmt::format("{}\n{:{}}", first ? "" : ",", "", 2 * (depth + 1));
    if (value.is_object()) out += Json(key).dump() + ": ";
    print(item, depth + 1, out);
    first = false;
  }
  out += fmt::format("\n{:{}}{}", "", 2 * depth, value.is_object() ? "}" : "]");
}

}  // namespace

const Json& report_schema() {
  static const Json schema =
      JsonDocument::load(data_root() / "harness" / "report" / "report.schema.json", ErrorKind::output).root();
  return schema;
}

void write_report(const fs::path& path, const Report& report) {
  const Json json = to_json(report);
  require_finite(json, "", path);
  const std::vector<std::string> violations = schema_violations(json, report_schema());
  if (!violations.empty()) {
    throw fail(ErrorKind::output,
               "{}: cannot be written: the report disobeys its schema {} times, first at {}", path.string(),
               violations.size(), violations.front());
  }
  std::string text;
  try {
    print(json, 0, text);
  } catch (const Json::exception& e) {  // text that is not UTF-8
    throw fail(ErrorKind::output, "{}: cannot be written: {}", path.string(), e.what());
  }
  text += '\n';  // no second text of hundreds of megabytes
  write_text(path, text);
}

Report read_report(const fs::path& path) {
  std::error_code ec;
  if (fs::exists(path, ec) && !fs::is_regular_file(path, ec) && !fs::is_directory(path, ec)) {
    throw fail(ErrorKind::config, "{}: is a pipe or a device, not a file; write the report into a file first",
               path.string());
  }
  const JsonDocument doc = JsonDocument::load(path, ErrorKind::config);
  check_schema(doc, report_schema());
  return report_from_json(doc.root());
}

fs::path report_file(const fs::path& file_or_folder) {
  std::error_code ec;
  return fs::is_directory(file_or_folder, ec) ? file_or_folder / "report.json" : file_or_folder;
}

Report read_report_at(const fs::path& file_or_folder) { return read_report(report_file(file_or_folder)); }

}  // namespace vsglbench
