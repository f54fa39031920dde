#include <fmt/format.h>

#include <algorithm>

#include "base/file.h"
#include "base/json.h"
#include "base/printable.h"
#include "cli/command.h"
#include "figure/figure.h"
#include "method/registry.h"
#include "run/case_key_docs.h"
#include "run/config.h"
#include "run/runner.h"
#include "scene/effects.h"
#include "scene/scene_file.h"

namespace vsglbench {
namespace {

Json list_methods() {
  Json out = Json::array();
  for (const MethodInfo* method : all_methods()) {
    out.push_back(to_json(*method));
    if (!method->refused.empty()) out.back()["summary"] = "refused: " + method->refused;
  }
  return out;
}

Json list_all_scenes(const std::string& assets) {
  Json out = Json::array();
  for (const auto& scene : list_scenes({data_root() / "scenes", assets_directory(assets)})) {
    out.push_back({{"name", scene.name},
                   {"summary", scene.description},
                   {"views", scene.views},
                   {"default_view", scene.default_view},
                   {"present", scene.asset_present},
                   {"get_it", scene.get_it}});
  }
  return out;
}

Json list_configs() {
  std::vector<std::filesystem::path> files;
  std::error_code ec;
  for (const auto& entry : std::filesystem::directory_iterator(data_root() / "configs", ec)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  Json out = Json::array();
  for (const auto& file : files) {
    try {
      const Json root = JsonDocument::load(file, ErrorKind::config).root();
      if (root.is_object() && root.contains("figure")) {
        out.push_back({{"name", file.stem().string()},
                       {"summary", load_figure_config(file, 0, 0).value("description", "")},
                       {"figure", root["figure"]}});
        continue;
      }
      const Config config = load_config(file);
      out.push_back(
          {{"name", file.stem().string()}, {"summary", config.description}, {"cases", config.cases.size()}});
    } catch (const Error& e) {  // one that is broken hides no other
      out.push_back({{"name", file.stem().string()},
                     {"summary", "broken: " + std::string(e.what())},
                     {"error", e.what()}});
    }
  }
  return out;
}

Json list_all_devices() {
  Json out = Json::array();
  for (const auto& d : list_devices()) {
    out.push_back({{"name", d.name},
                   {"summary", fmt::format("index {}, {}, {} {}, Vulkan {}, {} lanes a subgroup, UUID {}{}{}",
                                           d.index, d.type, d.driver, d.driver_version, d.api,
                                           d.subgroup_size, d.uuid, d.pci.empty() ? "" : ", PCI ", d.pci)},
                   {"index", d.index},
                   {"uuid", d.uuid},
                   {"pci", d.pci},
                   {"usable", d.missing.empty()},
                   {"missing", d.missing}});
  }
  return out;
}

// 64.0 as 64.
std::string number_text(const Json& value) {
  return value.is_number() ? fmt::format("{}", value.get<double>()) : value.dump();
}

Json list_effects() {
  Json out = Json::array();
  for (const std::string& name : effect_names())
    out.push_back({{"name", name}, {"summary", description(effect_named(name))}});
  return out;
}

void print_text(const Json& rows) {
  size_t width = 0;
  for (const auto& row : rows) width = std::max(width, row["name"].get<std::string>().size());
  for (const auto& row : rows) {
    fmt::print("{:<{}}  {}\n", printable(row["name"].get<std::string>()), width,
               printable(row["summary"].get<std::string>()));
    const std::string indent(width + 2, ' ');
    for (const auto& p : row.value("parameters", Json::array())) {
      const std::string range =
          p.contains("minimum") ? fmt::format("{} … {}", number_text(p["minimum"]), number_text(p["maximum"]))
                                : p["choices"].dump();
      fmt::print("{}{} (default {}; {}): {}\n", indent, p["name"].get<std::string>(),
                 number_text(p["default"]), range, p["description"].get<std::string>());
    }
    const Json defaults = row.value("case_defaults", Json());
    for (const auto& [key, value] : defaults.items())
      fmt::print("{}{} is {} unless a config says otherwise\n", indent, printable(key),
                 printable(value.dump()));
    if (row.contains("values")) {
      const Json& value = row["default"];
      fmt::print("{}default {}; {}; read by: {}\n", indent,
                 value.is_string() ? value.get<std::string>() : value.dump(),
                 row["values"].get<std::string>(), row["read_by"].get<std::string>());
    }
    if (row.contains("views")) {
      std::string views;
      for (const auto& v : row["views"]) views += (views.empty() ? "" : ", ") + v.get<std::string>();
      fmt::print("{}views: {}\n", indent, printable(views));
    }
    if (!row.value("present", true))
      fmt::print("{}not on this machine: {}\n", indent, printable(row["get_it"].get<std::string>()));
    if (row.contains("missing") && !row["missing"].empty())
      fmt::print("{}lacks {}\n", indent, row["missing"].dump());
  }
}

}  // namespace

void add_list_command(CLI::App& app, CommandResult*) {
  auto what = std::make_shared<std::string>();
  auto assets = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("list", "methods, scenes, configs, their keys, effects, or devices");
  command->footer("Example: vsglbench list methods --json");
  command->add_option("what", *what, "methods, scenes, configs, keys, effects or devices")
      ->required()
      ->check(CLI::IsMember({"methods", "scenes", "configs", "keys", "effects", "devices"}));
  command->add_option("--assets", *assets, "folder of downloaded scenes (default $VSGLBENCH_ASSETS)");
  command->add_flag("--json", *json, "as JSON");
  command->callback([=] {
    const Json rows = *what == "methods"   ? list_methods()
                      : *what == "scenes"  ? list_all_scenes(*assets)
                      : *what == "configs" ? list_configs()
                      : *what == "keys"    ? list_case_keys()
                      : *what == "effects" ? list_effects()
                                           : list_all_devices();
    if (*json) {
      fmt::print("{}\n", rows.dump(2));
    } else {
      print_text(rows);
    }
  });
}

}  // namespace vsglbench
