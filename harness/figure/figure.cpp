#include "figure/figure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/error.h"
#include "base/file.h"
#include "base/nearest.h"
#include "figure/sgl22.h"

namespace vsglbench {
namespace {

using MakeFigure = FigureOutput (*)(const FigureInputs&);
constexpr std::pair<const char*, MakeFigure> kFigures[] = {{"sgl22-1", sgl22::wall},
                                                           {"sgl22-2", sgl22::clamped_cosine},
                                                           {"sgl22-3", sgl22::hemisphere},
                                                           {"sgl22-4", sgl22::lights}};

Json figure_schema(const std::string& name) {
  const auto path = data_root() / "harness" / "figure" / "figure.schema.json";
  return JsonDocument::load(path, ErrorKind::config).root().at("$defs").at(name);
}

// A cell in quotes where it needs them (RFC 4180).
std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string out(1, '"');
  for (const char c : cell) out.append(c == '"' ? 2 : 1, c);
  return out += '"';
}

}  // namespace

std::string FigureTable::cell(double value) { return fmt::format("{:.10g}", value); }

std::string FigureTable::csv() const {
  std::string out = fmt::format("{}\n", fmt::join(columns, ","));
  for (const auto& row : rows) {
    std::vector<std::string> cells;
    for (const auto& cell : row) cells.push_back(quoted(cell));
    out += fmt::format("{}\n", fmt::join(cells, ","));
  }
  return out;
}

const std::vector<std::string>& figure_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [name, make] : kFigures) all.push_back(name);
    return all;
  }();
  return names;
}

Json load_figure_config(const std::filesystem::path& path, uint32_t width, uint32_t height) {
  const JsonDocument document = JsonDocument::load(path, ErrorKind::config);
  if (!document.root().is_object() || !document.root().contains("figure")) {
    throw document.error(
        "", "describes no figure: it has no key \"figure\"; run experiments with `vsglbench run`");
  }
  const Json& figure = document.root()["figure"];
  const auto& names = figure_names();
  if (!figure.is_string() || std::ranges::count(names, figure.get<std::string>()) == 0) {
    throw document.error("/figure",
                         fmt::format("names no figure: {}{}", figure.dump(),
                                     figure.is_string() ? suggestion(figure.get<std::string>(), names) : ""));
  }
  check_schema(document, figure_schema(figure));
  Json config = document.root();
  for (const auto& [key, size] : {std::pair("width", width), std::pair("height", height)}) {
    if (size == 0) continue;
    if (!config.contains(key)) {
      throw fail(ErrorKind::usage, "--{} means nothing to {}: it has no image", key,
                 figure.get<std::string>());
    }
    config[key] = size;
  }
  return config;
}

FigureOutput make_figure(const FigureInputs& inputs) {
  const std::string name = inputs.config.at("figure");
  for (const auto& [known, make] : kFigures) {
    if (known == name) return make(inputs);
  }
  throw fail(ErrorKind::config, "no figure '{}'{}", name, suggestion(name, figure_names()));
}

std::vector<std::filesystem::path> write_figure(const FigureOutput& figure,
                                                const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const FigureTable& table : figure.tables) {
    paths.push_back(folder / (table.name + ".csv"));
    write_text(paths.back(), table.csv());
  }
  for (const auto& [name, plot] : figure.plots) {
    paths.push_back(folder / (name + ".svg"));
    write_text(paths.back(), to_svg(plot));
  }
  for (const auto& [name, bitmap] : figure.images) {
    paths.push_back(folder / (name + ".png"));
    write_png(paths.back(), bitmap);
  }
  return paths;
}

}  // namespace vsglbench
