#include "papers/exhibit.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "base/file.h"
#include "base/nearest.h"
#include "run/config.h"

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

constexpr const char* kLights = "-lights";

// A sheet of what is not made would lack a part, and nobody would know.
void check_sheet(const JsonDocument& doc, size_t index, const Exhibit& e) {
  Strings known = e.runs;
  for (const std::string& config : e.lights) known.push_back(config + kLights);
  if (!e.figure.empty()) known.push_back(e.figure);
  for (size_t i = 0; i < e.sheet.size(); ++i) {
    const SheetPart& part = e.sheet[i];
    const std::string at = fmt::format("/exhibits/{}/sheet/{}", index, i);
    if (std::ranges::count(known, part.run) == 0)
      throw doc.error(at + "/run", fmt::format("'{}' makes no '{}'{}", e.name, part.run,
                                               known.empty() ? "" : suggestion(part.run, known)));
    if (part.images.empty() && part.files.empty()) throw doc.error(at, "shows nothing; give images or files");
    if (!part.images.empty() && std::ranges::count(e.runs, part.run) == 0)
      throw doc.error(at + "/images", "are pictures of a run; of lights and figures give files");
  }
  if (e.largest_kernel && e.runs.empty())
    throw doc.error(fmt::format("/exhibits/{}/largest_kernel", index), "is found in a run; name one in runs");
}

// The file that a config is, however it is named; one that is not there is told by whoever reads it.
std::string file_of(const std::string& config) {
  std::error_code ec;
  try {
    return std::filesystem::weakly_canonical(config_path(config), ec).string();
  } catch (const Error&) {
    return config;
  }
}

// Two files of one name would take turns in one folder, and each find the other's work there.
void check_folders(const JsonDocument& doc, const std::vector<Exhibit>& exhibits) {
  std::map<std::string, std::string> owners = {{folder_of("code-size", ""), "the sizes of code"}};
  for (size_t i = 0; i < exhibits.size(); ++i) {
    const auto take = [&](const std::string& key, const std::string& config, const std::string& of) {
      const std::string folder = folder_of(config, of), owner = file_of(config) + of;
      const auto [at, is_new] = owners.emplace(folder, owner);
      if (!is_new && at->second != owner)
        throw doc.error(
            fmt::format("/exhibits/{}/{}", i, key),
            fmt::format("'{}' would share the folder '{}' with {}; rename it", config, folder, at->second));
    };
    for (const std::string& config : exhibits[i].runs) take("runs", config, "");
    for (const std::string& config : exhibits[i].lights) take("lights", config, kLights);
    if (!exhibits[i].figure.empty()) take("figure", exhibits[i].figure, "");
  }
}

}  // namespace

std::string folder_of(const std::string& config, const std::string& of) {
  return std::filesystem::path(config).stem().string() + of;
}

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
    check_sheet(doc, out.size() - 1, out.back());
  }
  check_folders(doc, out);
  return out;
}

std::vector<Exhibit> select_exhibits(const std::vector<Exhibit>& all, const Strings& names) {
  if (names.empty() || std::ranges::count(names, "all") > 0) return all;
  Strings known = {"all"};
  for (const Exhibit& e : all) known.push_back(e.name);
  for (const std::string& name : names) {
    if (std::ranges::count(known, name) == 0)
      throw fail(ErrorKind::usage, "no table or figure '{}'{}", name, suggestion(name, known));
  }
  std::vector<Exhibit> out;
  for (const Exhibit& e : all) {
    if (std::ranges::count(names, e.name) > 0) out.push_back(e);
  }
  return out;
}

}  // namespace vsglbench
