#include "papers/exhibit.h"

#include <algorithm>

#include "base/error.h"
#include "base/file.h"
#include "base/nearest.h"

namespace vsglbench {
namespace {

using Strings = std::vector<std::string>;

PublishedColumn column_of(const Json& json) {
  PublishedColumn column{json.at("head"), json.at("machine"), json.at("cases"), json.value("scene", "*"), {}};
  for (const Json& row : json.at("rows"))
    column.rows.push_back({row.at("name"), row.value("published", ""), row.at("passes").get<Strings>(),
                           row.value("sum", false)});
  return column;
}

SheetPart sheet_part_of(const Json& json) {
  return {json.at("run"), json.value("cases", "*"), json.value("images", Strings()),
          json.value("files", Strings())};
}

Exhibit exhibit_of(const Json& json) {
  Exhibit e;
  e.name = json.at("name");
  e.source = json.at("source");
  e.title = json.at("title");
  e.differs = json.value("differs", "");
  e.runs = json.value("runs", Strings());
  e.lights = json.value("lights", Strings());
  e.light_cases = json.value("light_cases", Strings());
  e.figure = json.value("figure", "");
  e.quick_width = json.value("quick_width", 0u);
  e.quick_height = json.value("quick_height", 0u);
  e.largest_kernel = json.value("largest_kernel", false);
  e.edges = json.value("edges", false);
  e.code_size = json.value("code_size", false);
  e.columns = json.value("columns", Strings());
  e.claims = json.value("claims", Strings());
  for (const Json& column : json.value("table", Json::array())) e.table.push_back(column_of(column));
  for (const Json& part : json.value("sheet", Json::array())) e.sheet.push_back(sheet_part_of(part));
  return e;
}

}  // namespace

std::vector<Exhibit> load_exhibits(const std::filesystem::path& file) {
  const auto folder = data_root() / "harness" / "papers";
  static const Json schema = JsonDocument::load(folder / "exhibits.schema.json", ErrorKind::output).root();
  const JsonDocument doc =
      JsonDocument::load(file.empty() ? folder / "exhibits.json" : file, ErrorKind::config);
  check_schema(doc, schema);
  std::vector<Exhibit> out;
  for (const Json& json : doc.root().at("exhibits")) {
    out.push_back(exhibit_of(json));
    const auto named = [&](const Exhibit& e) { return e.name == out.back().name; };
    if (std::ranges::count_if(out, named) > 1)
      throw doc.error(fmt::format("/exhibits/{}/name", out.size() - 1),
                      fmt::format("'{}' comes twice", out.back().name));
  }
  return out;
}

std::vector<Exhibit> select_exhibits(const std::vector<Exhibit>& all, const Strings& names) {
  if (names.empty() || std::ranges::count(names, "all") > 0) return all;
  Strings known;
  for (const Exhibit& e : all) known.push_back(e.name);
  for (const std::string& name : names) {
    if (std::ranges::count(known, name) == 0)
      throw fail(ErrorKind::usage, "no table or figure '{}'{}; there are all, {}", name,
                 suggestion(name, known), fmt::join(known, ", "));
  }
  std::vector<Exhibit> out;
  for (const Exhibit& e : all) {
    if (std::ranges::count(names, e.name) > 0) out.push_back(e);
  }
  return out;
}

}  // namespace vsglbench
