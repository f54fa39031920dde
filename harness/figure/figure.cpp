#include "figure/figure.h"

#include <fmt/format.h>

#include "base/csv.h"
#include "base/error.h"
#include "base/file.h"
#include "base/nearest.h"
#include "figure/sgl22.h"
#include "report/image_labels.h"

namespace vsglbench {
namespace {

using MakeFigure = FigureOutput (*)(const FigureInputs&);
constexpr std::pair<const char*, MakeFigure> kFigures[] = {{"sgl22-1", sgl22::wall},
                                                           {"sgl22-2", sgl22::clamped_cosine},
                                                           {"sgl22-3", sgl22::hemisphere},
                                                           {"sgl22-4", sgl22::lights}};

}  // namespace

const char* finding_name(Finding finding) {
  switch (finding) {
    case Finding::holds:
      return "holds";
    case Finding::does_not_hold:
      return "does not hold";
    case Finding::undecided:
      return "undecided";
  }
  return "";
}

std::string FigureTable::cell(double value) { return fmt::format("{:.10g}", value); }

std::string FigureTable::csv() const {
  std::string out = csv_row(columns);
  for (const auto& row : rows) out += csv_row(row);
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
  const Gnuplot gnuplot;
  for (const auto& [name, plot] : figure.plots) {
    for (const auto& [format, ending] :
         {std::pair(PlotFormat::svg, ".svg"), {PlotFormat::png, "-plot.png"}}) {
      paths.push_back(folder / (name + ending));
      write_text(paths.back(), draw_plot(gnuplot, plot, format));
    }
  }
  for (const auto& [name, bitmap] : figure.images) {
    paths.push_back(folder / (name + ".png"));
    write_png(paths.back(), bitmap, image_labels(name));
  }
  return paths;
}

}  // namespace vsglbench
