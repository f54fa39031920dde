// Every figure at a small size, held to what the paper says of it and to double precision.
#include "figure/figure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/file.h"

using namespace vsglbench;

namespace {

Device& device() {
  static Device d;
  return d;
}

Json config(const std::string& name) {
  return load_figure_config(data_root() / "configs" / (name + ".json"), 0, 0);
}

FigureOutput make(const Json& config) { return make_figure({device(), config, {}}); }

const FigureTable& table(const FigureOutput& figure, const std::string& name) {
  for (const FigureTable& t : figure.tables) {
    if (t.name == name) return t;
  }
  throw std::out_of_range(name);
}

// The number in `column` of the first row whose first cells are these.
double number(const FigureTable& table, const std::vector<std::string>& first, const std::string& column) {
  const auto at = std::find(table.columns.begin(), table.columns.end(), column) - table.columns.begin();
  for (const auto& row : table.rows) {
    if (std::equal(first.begin(), first.end(), row.begin()))
      return std::stod(row.at(static_cast<size_t>(at)));
  }
  ADD_FAILURE() << table.name << " has no row " << first.front();
  return std::nan("");
}

const Claim& claim(const FigureOutput& figure, const std::string& part) {
  for (const Claim& c : figure.claims) {
    if (c.text.find(part) != std::string::npos) return c;
  }
  throw std::out_of_range(part);
}

void expect_whole(const FigureOutput& figure) {
  for (const FigureTable& t : figure.tables) {
    EXPECT_FALSE(t.rows.empty()) << t.name;
    for (const auto& row : t.rows) EXPECT_EQ(row.size(), t.columns.size()) << t.name;
  }
  for (const auto& [name, plot] : figure.plots) EXPECT_NO_THROW(plot_script(plot, PlotFormat::svg)) << name;
}

}  // namespace

TEST(FigureWall, TheNewKernelIsBetterThanItsForerunners) {
  Json c = config("sgl22-1");
  c["width"] = 64;
  c["height"] = 36;
  const FigureOutput figure = make(c);
  expect_whole(figure);
  const FigureTable& t = table(figure, "sgl22-1");
  const auto smape = [&](const char* kernel) { return number(t, {kernel}, "smape_percent"); };
  EXPECT_LT(smape("tokuyoshi2022"), smape("meder-bruederlin"));
  EXPECT_LT(smape("tokuyoshi2022"), smape("pettineo-hill"));
  EXPECT_LT(smape("tokuyoshi2022"), smape("cosine"));
  EXPECT_LT(smape("tokuyoshi2024"), smape("tokuyoshi2022"));
  EXPECT_EQ(claim(figure, "SMAPE").finding, Finding::holds);
  // Far from its foot the light is a planar Gaussian of cosines N(h/d,σ²/d²): E max(x,0), times d, is
  // hΦ(h/σ) + σφ(h/σ).
  const FigureTable& along = table(figure, "sgl22-1-profile");
  const auto& last = along.rows.back();
  const double far = 0.02 * (0.5 * std::erfc(-1 / std::sqrt(2.0)) + std::exp(-0.5) / std::sqrt(2 * M_PI));
  EXPECT_NEAR(std::stod(last.at(6)) * std::stod(last.at(2)) / far, 1, 2e-3);
}

// A light that is far smaller than its distance is a point: every kernel's L is the cosine, or nearly so.
TEST(FigureWall, ASmallLightIsAPoint) {
  Json c = config("sgl22-1");
  c["width"] = 32;
  c["height"] = 18;
  c["light_sigma"] = 1e-4;
  c["light_height"] = 1;
  const FigureOutput figure = make(c);
  EXPECT_LT(number(table(figure, "sgl22-1"), {"cosine"}, "smape_percent"), 1e-3);
  EXPECT_LT(number(table(figure, "sgl22-1"), {"tokuyoshi2024"}, "smape_percent"), 1e-3);
}

TEST(FigureCosine, ReproducesThePublishedParameters) {
  const FigureOutput figure = make(config("sgl22-2"));
  expect_whole(figure);
  for (const Claim& c : figure.claims) EXPECT_EQ(c.finding, Finding::holds) << c.text << ": " << c.figures;
  const FigureTable& t = table(figure, "sgl22-2-parameters");
  EXPECT_NEAR(number(t, {"tokuyoshi2022", "alpha"}, "value"), 1182.2467, 1e-3);
  EXPECT_NEAR(number(t, {"tokuyoshi2022", "error_bound"}, "value"), 2.819e-4, 1e-6);
  // At the pole μ-α-1, and below the horizon nothing.
  EXPECT_NEAR(number(table(figure, "sgl22-2"), {"meder-bruederlin", "formula", "0"}, "difference"), 0.0077,
              1e-9);
  EXPECT_NEAR(number(table(figure, "sgl22-2"), {"meder-bruederlin", "published", "0"}, "difference"), 0.005,
              1e-9);
  EXPECT_NEAR(number(table(figure, "sgl22-2"), {"tokuyoshi2022", "formula", "0"}, "difference"), 1.40955e-4,
              1e-8);
}

TEST(FigureHemisphere, TheNewApproximationIsBetterForSharpLobes) {
  Json c = config("sgl22-3");
  c["steps"] = 24;
  c["cosines"] = 101;
  const FigureOutput figure = make(c);
  expect_whole(figure);
  EXPECT_EQ(claim(figure, "large sharpness").finding, Finding::holds)
      << claim(figure, "large sharpness").figures;
  EXPECT_EQ(claim(figure, "even for small").finding, Finding::holds)
      << claim(figure, "even for small").figures;
  // Single precision adds nothing that shows.
  const FigureTable& t = table(figure, "sgl22-3");
  for (size_t i = 0; i + 1 < t.rows.size(); i += 2) {
    ASSERT_EQ(t.rows[i][2], t.rows[i + 1][2]);
    EXPECT_NEAR(std::stod(t.rows[i][3]), std::stod(t.rows[i + 1][3]), 3e-7) << t.rows[i][2];
  }
}

TEST(FigureLights, OnlyPettineoAndHillLeavesBlackSplotches) {
  Json c = config("sgl22-4");
  c["width"] = 96;
  c["height"] = 54;
  c["image"] = {{"width", 48}, {"height", 27}};
  c["repetitions"] = 2;
  const FigureOutput figure = make(c);
  expect_whole(figure);
  const FigureTable& t = table(figure, "sgl22-4");
  EXPECT_GT(number(t, {"pettineo-hill"}, "black_pixels"), 0);
  for (const char* kernel : {"meder-bruederlin", "tokuyoshi2022", "tokuyoshi2024"}) {
    EXPECT_EQ(number(t, {kernel}, "black_pixels"), 0) << kernel;
    EXPECT_LT(number(t, {kernel}, "smape_percent"), 2) << kernel;
  }
  for (const auto& row : t.rows) EXPECT_GT(std::stod(row.at(4)), 0) << row.front();
}

TEST(FigureLights, RefusesLightsThatAreNoGaussians) {
  Json c = config("sgl22-4");
  c["method"] = "vpl";
  EXPECT_THROW(make(c), Error);
}

TEST(FigureTable, QuotesCells) {
  FigureTable t{"t", {"a", "b"}, {}};
  t.add(std::string("x, \"y\""), 1.0 / 3);
  EXPECT_EQ(t.csv(), "a,b\n\"x, \"\"y\"\"\",0.3333333333\n");
}
