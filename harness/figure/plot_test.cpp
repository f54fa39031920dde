#include "figure/plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"

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

void expect_refused(const Plot& plot, const std::string& part) {
  try {
    to_svg(plot);
    ADD_FAILURE() << "taken; expected: " << part;
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
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
}

TEST(Plot, EscapesTextAndNamesEverything) {
  Plot plot = plot_of({{0, 1}, {1, 2}});
  plot.title = "a < b & \"c\"";
  plot.notes = {"<script>"};
  plot.curves.push_back({"κ > 1", {{0, 2}}, CurveStyle::points});
  const std::string svg = to_svg(plot);
  EXPECT_NE(svg.find(">a &lt; b &amp; &quot;c&quot;</text>"), std::string::npos);
  EXPECT_EQ(svg.find("<script>"), std::string::npos);
  for (const char* part : {">κ &gt; 1</text>", ">one</text>", ">distance / m</text>", ">error / %</text>"}) {
    EXPECT_EQ(occurrences(svg, part), 1u) << part;
  }
  EXPECT_EQ(occurrences(svg, "<polyline"), 2u);  // a curve and its key; points have none
  EXPECT_EQ(occurrences(svg, "<circle"), 2u);
  EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
}

// Values grow to the right and upwards; on a logarithmic axis, by their ratio.
TEST(Plot, PutsPointsWhereTheyBelong) {
  const auto points = [](const std::string& svg) {
    const size_t from = svg.find("points=\"") + 8;
    std::vector<glm::dvec2> out;
    const char* at = svg.c_str() + from;
    char* end;
    while (*at != '"') {
      const double x = std::strtod(at, &end), y = std::strtod(end + 1, &end);
      out.push_back({x, y});
      at = end + 1;
    }
    return out;
  };
  const auto linear = points(to_svg(plot_of({{0, 1}, {5, 3}, {10, 2}})));
  ASSERT_EQ(linear.size(), 3u);
  EXPECT_NEAR(linear[1].x, (linear[0].x + linear[2].x) / 2, 0.02);
  EXPECT_NEAR(linear[2].y, (linear[0].y + linear[1].y) / 2, 0.02);
  EXPECT_GT(linear[0].y, linear[1].y);
  const auto log = points(to_svg(plot_of({{1e-3, 1}, {1, 10}, {1e3, 100}}, true)));
  EXPECT_NEAR(log[1].x, (log[0].x + log[2].x) / 2, 0.02);
  EXPECT_NEAR(log[1].y, (log[0].y + log[2].y) / 2, 0.02);
}

TEST(Plot, TicksAreRoundNumbersAndFew) {
  const std::string linear = to_svg(plot_of({{0, 0}, {90, 0.0077}}));
  for (const char* part : {">0</text>", ">20</text>", ">0.002</text>"})
    EXPECT_GE(occurrences(linear, part), 1u);
  const std::string log = to_svg(plot_of({{1e-2, 1e-9}, {1e4, 1}}, true));
  for (const char* part : {">10⁻²</text>", ">10⁴</text>"}) EXPECT_GE(occurrences(log, part), 1u);
  EXPECT_LE(occurrences(log, "<text"), 24u);
  // One value alone, 0 too, has an axis.
  for (const double value : {0.0, 3.0, -2.0})
    EXPECT_EQ(to_svg(plot_of({{value, value}})).find("nan"), std::string::npos);
  EXPECT_EQ(to_svg(plot_of({{2, 2}}, true)).find("nan"), std::string::npos);
}
