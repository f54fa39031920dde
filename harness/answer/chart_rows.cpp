#include "answer/chart_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "image/font.h"

namespace vsglbench {
namespace {

constexpr double kRow = 27, kWidestName = 560;  // pixels
constexpr double kLeastHeight = 420, kLeastPlot = 560;

}  // namespace

std::string bar_block(const std::string& name, const std::vector<ChartBar>& bars) {
  std::string out = fmt::format("${} << END\n", name);
  for (const ChartBar& b : bars) {
    const double y = static_cast<double>(b.row), low = std::min(b.from, b.to), high = std::max(b.from, b.to);
    out +=
        fmt::format("{:.9g} {} {:.9g} {:.9g} {} {}\n", 0.5 * (low + high), y, low, high, y - 0.36, y + 0.36);
  }
  return out + "END\n";
}

std::string bar_curve(const std::string& name, const std::string& colour, const std::string& title) {
  return fmt::format("${} using 1:2:3:4:5:6 with boxxyerror fs solid 1 border lc rgb 'white' fc rgb '{}' {}",
                     name, colour,
                     title.empty() ? "notitle" : "title " + Gnuplot::quoted(title) + " noenhanced");
}

std::string name_rows(Chart* chart, const std::vector<std::string>& names) {
  const Font font(13);
  double widest = 60;
  std::vector<std::string> tics;
  for (size_t i = 0; i < names.size(); ++i) {
    const std::string name = font.fit(names[i], kWidestName);
    widest = std::max(widest, font.width(name));
    tics.push_back(fmt::format("{} {}", Gnuplot::quoted(name), i));
  }
  chart->left = 30 + 1.08 * widest;
  chart->width = std::max(chart->width, static_cast<uint32_t>(chart->left + kLeastPlot + chart->right));
  const double beside = chart->height - (plot_place(*chart).bottom - plot_place(*chart).top);
  chart->height =
      static_cast<uint32_t>(std::max(kLeastHeight, beside + kRow * static_cast<double>(names.size())));
  return fmt::format("set yrange [{}:-0.8]\nset ytics scale 0 font small noenhanced ({})\nset grid noytics\n",
                     static_cast<double>(names.size()) - 0.2, fmt::join(tics, ", "));
}

}  // namespace vsglbench
