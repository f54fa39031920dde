#include "figure/plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "base/error.h"
#include "base/file.h"
#include "image/png.h"

using namespace vsglbench;

namespace {

size_t occurrences(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

Plot plot_of(std::vector<glm::dvec2> points, bool log = false) {
  return {.title = "t", .x = {"distance / m", log}, .y = {"error / %", log}, .curves = {{"one", points}}};
}

std::string svg_of(const Plot& plot) { return draw_plot(Gnuplot(), plot, PlotFormat::svg); }

void expect_refused(const Plot& plot, const std::string& part) {
  try {
    plot_script(plot, PlotFormat::svg);
    ADD_FAILURE() << "taken; expected: " << part;
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

// The corners of the first curve, in pixels of the SVG.
std::vector<glm::dvec2> corners(const std::string& svg) {
  std::vector<glm::dvec2> out;
  const size_t key =
      svg.find("d='M", svg.find("<title>one</title>")) + 4;  // its line in the legend comes first
  const size_t from = svg.find('M', key) + 1, to = svg.find('\'', from);
  const char* at = svg.c_str() + from;
  char* end = nullptr;
  while (at < svg.c_str() + to) {
    const double x = std::strtod(at, &end), y = std::strtod(end + 1, &end);
    out.push_back({x, y});
    at = end + 1 + (*end == ' ');
  }
  return out;
}

}  // namespace

TEST(Plot, RefusesWhatItCannotDraw) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  expect_refused({.title = "empty"}, "plot 'empty' has no curve");
  expect_refused(plot_of({}), "curve 'one' has no points");
  expect_refused(plot_of({{0, 1}, {1, nan}}), "curve 'one' has the point (1, nan), which is not finite");
  expect_refused(plot_of({{infinity, 1}}), "not finite");
  expect_refused(plot_of({{1, 0}}, true), "a logarithmic axis can't show");
  expect_refused(plot_of({{-1, 2}}, true), "a logarithmic axis can't show");
  Plot bars = plot_of({{1, 2}}, true);
  bars.curves[0].errors = {{{1, 0}, {1, 3}}};
  expect_refused(bars, "curve 'one' has the point (1, 0)");
}

TEST(Plot, NamesEverythingAsItStands) {
  Plot plot = plot_of({{0, 1}, {1, 2}});
  plot.title = "a < b & \"c\" it's {x}_2^3 @d";
  plot.notes = {"<script>", "100 % \\n"};
  plot.curves.push_back({"κ > 1", {{0, 2}}, CurveStyle::points});
  const std::string svg = svg_of(plot);
  EXPECT_EQ(svg.find("<script>"), std::string::npos);
  for (const char* part : {"a &lt; b &amp; ", " it’s {x}_2^3 @d<", ">κ > 1<", ">one<", ">distance / m<",
                           ">error / %<", "&lt;script>", "100 % \\n"}) {
    EXPECT_GE(occurrences(svg, part), 1u) << part;
  }
  EXPECT_NE(svg.find("<svg "), std::string::npos);
  EXPECT_TRUE(svg.ends_with("</svg>\n\n")) << svg.substr(svg.size() - 20);
}

// gnuplot runs commands in backquotes and after "system", and pipes to an output that begins with "|".
TEST(Plot, NoTextIsACommand) {
  const auto folder =
      std::filesystem::path(testing::TempDir()) / ("vsglbench-plot-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::string touch = "touch " + (folder / "x").string();
  for (const auto& text :
       {"`" + touch + "`", "'; system('" + touch + "'); '", "\"; system(\"" + touch + "\") #",
        "'\nsystem '" + touch + "'\n'", "\nEND\n!" + touch + "\n", "|" + touch, "\\'; !" + touch}) {
    Plot plot = plot_of({{0, 1}, {1, 2}});
    plot.title = plot.x.label = plot.y.label = plot.curves[0].name = text;
    plot.notes = {text};
    EXPECT_NE(svg_of(plot).find("</svg>"), std::string::npos) << text;
    EXPECT_TRUE(std::filesystem::is_empty(folder)) << text;
  }
  std::filesystem::remove_all(folder);
}

// Values grow to the right and upwards; on a logarithmic axis, by their ratio.
TEST(Plot, PutsPointsWhereTheyBelong) {
  const auto linear = corners(svg_of(plot_of({{0, 1}, {5, 3}, {10, 2}})));
  ASSERT_EQ(linear.size(), 3u);
  EXPECT_NEAR(linear[1].x, (linear[0].x + linear[2].x) / 2, 0.2);
  EXPECT_NEAR(linear[2].y, (linear[0].y + linear[1].y) / 2, 0.2);
  EXPECT_GT(linear[0].y, linear[1].y);
  const auto log = corners(svg_of(plot_of({{1e-3, 1}, {1, 10}, {1e3, 100}}, true)));
  ASSERT_EQ(log.size(), 3u);
  EXPECT_NEAR(log[1].x, (log[0].x + log[2].x) / 2, 0.2);
  EXPECT_NEAR(log[1].y, (log[0].y + log[2].y) / 2, 0.2);
}

TEST(Plot, TicksAreRoundNumbersAndFew) {
  const std::string linear = svg_of(plot_of({{0, 0}, {90, 0.0077}}));
  for (const char* part : {"> 0<", "> 20<", "> 0.002<"}) EXPECT_GE(occurrences(linear, part), 1u) << part;
  const std::string few = svg_of(plot_of({{3, 40}, {30, 90}}, true));
  for (const char* part : {"> 5<", "> 10<", "> 20<", "> 50<"}) EXPECT_GE(occurrences(few, part), 1u) << part;
  EXPECT_LE(occurrences(svg_of(plot_of({{1e-2, 1e-9}, {1e4, 1}}, true)), "<text"), 24u);
  // One value alone, 0 too, has an axis.
  for (const double value : {0.0, 3.0, -2.0}) EXPECT_NO_THROW(svg_of(plot_of({{value, value}})));
  EXPECT_NO_THROW(svg_of(plot_of({{2, 2}}, true)));
}

TEST(Plot, ErrorBarsReachTheirEnds) {
  Plot plot = plot_of({{1, 1}, {2, 2}});
  plot.y.from_zero = true;
  plot.curves[0].style = CurveStyle::points;
  const std::string without = svg_of(plot);
  plot.curves[0].errors = {{{1, 0.5}, {1, 4}}, {{1.5, 2}, {2.5, 2}}};
  const std::string with = svg_of(plot);
  EXPECT_EQ(without.find("> 4<"), std::string::npos);
  EXPECT_GE(occurrences(with, "> 4<"), 1u) << "the axis holds the bar";
  plot.curves[0].errors.pop_back();
  EXPECT_THROW(svg_of(plot), std::logic_error);
}

TEST(Plot, AsPngHasItsSizeAndItsColours) {
  Plot plot = plot_of({{0, 1}, {1, 2}});
  plot.width = 500, plot.height = 300;
  for (int i = 1; i < 6; ++i) plot.curves.push_back({std::to_string(i), {{0, i}, {1, i}}});
  const auto file = std::filesystem::path(testing::TempDir()) / "vsglbench-plot.png";
  write_text(file, draw_plot(Gnuplot(), plot, PlotFormat::png));
  const Bitmap b = read_png(file);
  EXPECT_EQ(b.width, 500u);
  EXPECT_EQ(b.height, 300u);
  for (const glm::u8vec3 color :
       {glm::u8vec3(0x00, 0x72, 0xb2), glm::u8vec3(0xd5, 0x5e, 0x00), glm::u8vec3(0x00, 0x9e, 0x73),
        glm::u8vec3(0xcc, 0x79, 0xa7), glm::u8vec3(0xe6, 0x9f, 0x00), glm::u8vec3(0x56, 0xb4, 0xe9)}) {
    size_t found = 0;
    for (uint32_t y = 0; y < b.height; ++y) {
      for (uint32_t x = 0; x < b.width; ++x)
        found += b.at(x, y)[0] == color.x && b.at(x, y)[1] == color.y && b.at(x, y)[2] == color.z;
    }
    EXPECT_GT(found, 10u) << int(color.x) << " " << int(color.y) << " " << int(color.z);
  }
}

TEST(Gnuplot, SaysOnOneLineWhatIsWrong) {
  const Gnuplot gnuplot;
  EXPECT_GE(std::stod(gnuplot.version()), 5.0);
  try {
    gnuplot.run("set title 'x'\nplot nothing with lines\n");
    ADD_FAILURE() << "taken";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::output);
    EXPECT_EQ(std::string(e.what()), "gnuplot: line 0: undefined variable: nothing");
  }
}

TEST(Gnuplot, WhereItIsMissingThePackageIsNamed) {
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  try {
    const Gnuplot gnuplot;
    ADD_FAILURE() << "found";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("install the package gnuplot-nox"), std::string::npos) << e.what();
  }
  ::setenv("PATH", path.c_str(), 1);
}
