// [SGL22] Fig. 2: SG approximations of the clamped cosine, (μ G(ω;n,λ) - α) H(ω·n), minus the cosine itself;
// and the λ that the paper finds by minimising its error bound.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "figure/sgl22.h"
#include "operation/sg_evaluation.h"

namespace vsglbench::sgl22 {
namespace {

constexpr double kPublishedLambda = 0.00084560872241480124;

double square(double x) { return x * x; }

// 2(e^λ-1-λ), which cancels otherwise: λ² + λ³/3 + λ⁴/12 + ...
double denominator(double lambda) {
  return lambda * lambda * (1 + lambda / 3 * (1 + lambda / 4 * (1 + lambda / 5 * (1 + lambda / 6))));
}

// μG-α of Meder and Brüderlin, and [SGL22]'s α(e^λ G - 1), minus the cosine; 0 below the horizon.
double meder_difference(double cosine, double alpha) {
  return cosine > 0 ? 32.708 * std::exp(0.0315 * (cosine - 1)) - alpha - cosine : 0;
}
double tokuyoshi_difference(double cosine) {
  const double alpha = kPublishedLambda / denominator(kPublishedLambda);
  return cosine > 0 ? alpha * std::expm1(kPublishedLambda * cosine) - cosine : 0;
}

// E_{n,∞}(λ) [SGL22 §2] for ε = 2^-23. Unlike the paper's print, whose denominator 2e^λ-2-λ has lost a factor
// 2 of its last term: α = λ/(2e^λ-2-2λ) stands before it.
double error_bound(double lambda) {
  const double half = 0.5 * 0x1p-23;
  const double difference = std::expm1(lambda) + half * std::exp(lambda) + half;
  return (1 + half) * lambda * difference / denominator(lambda) - 1;
}

// The argument at the bottom of a function with one valley in [low, high]: golden section in the logarithm.
double least_argument(double low, double high, double (*f)(double)) {
  double a = std::log(low), b = std::log(high);
  constexpr double kGolden = 1 / std::numbers::phi;
  for (int i = 0; i < 80; ++i) {
    const double left = b - kGolden * (b - a), right = a + kGolden * (b - a);
    (f(std::exp(left)) < f(std::exp(right)) ? b : a) = f(std::exp(left)) < f(std::exp(right)) ? right : left;
  }
  return std::exp(0.5 * (a + b));
}

FigureTable parameters() {
  const double found = least_argument(1e-6, 1e-1, error_bound);
  FigureTable t{"sgl22-2-parameters", {"approximation", "parameter", "origin", "value", "source"}, {}};
  const std::string meder = "meder-bruederlin", ours = "tokuyoshi2022", published = "published",
                    formula = "formula";
  const std::string section = "[SGL22] §2";
  t.add(meder, std::string("lambda"), published, 0.0315, section);
  t.add(meder, std::string("mu"), published, 32.708, section);
  t.add(meder, std::string("alpha"), published, 31.703, section);
  t.add(meder, std::string("alpha"), formula, 31.7003,
        std::string("Meder and Brüderlin 2018, as evaluated here"));
  t.add(ours, std::string("lambda"), published, kPublishedLambda, section);
  t.add(ours, std::string("lambda"), formula, found,
        std::string("least of E(λ), its denominator read as 2e^λ-2-2λ"));
  t.add(ours, std::string("alpha"), formula, kPublishedLambda / denominator(kPublishedLambda),
        std::string("λ/(2e^λ-2-2λ)"));
  t.add(ours, std::string("error_bound"), formula, error_bound(kPublishedLambda),
        std::string("E(λ) at the published λ"));
  return t;
}

struct Series {
  std::string name, approximation, origin;
  std::vector<double> differences;  // one an angle
};

// The models at a sharpness where the light is a direction: L(v,κ) is then the clamped cosine.
Series on_device(const FigureInputs& inputs, exact::DiffuseModel model, const std::vector<double>& angles) {
  std::vector<float> rows;
  for (const double angle : angles) {
    rows.insert(rows.end(), {std::clamp(static_cast<float>(std::cos(angle)), -1.0f, 1.0f), 0x1p41f});
  }
  const std::vector<float> values =
      SgEvaluator(inputs.device, {SgFunction::clamped_cosine, model}).values(rows);
  Series s{name(model) + ", GPU, κ = 2⁴¹", name(model), "measured", {}};
  for (size_t i = 0; i < values.size(); ++i) s.differences.push_back(values[i] - std::max(rows[2 * i], 0.0f));
  return s;
}

Curve curve_of(const Series& s, const std::vector<double>& angles) {
  Curve curve{s.name, {}, CurveStyle::line, s.origin == "published"};
  for (size_t i = 0; i < angles.size(); ++i) {
    curve.points.push_back({angles[i] * 180 / std::numbers::pi, s.differences[i]});
  }
  return curve;
}

double largest(const Series& s) {
  double most = 0;
  for (const double d : s.differences) most = std::max(most, std::abs(d));
  return most;
}

Series formula(const char* name, const char* approximation, const char* origin,
               const std::vector<double>& angles, double (*difference)(double)) {
  Series s{name, approximation, origin, {}};
  for (const double angle : angles) s.differences.push_back(difference(std::cos(angle)));
  return s;
}

}  // namespace

FigureOutput clamped_cosine(const FigureInputs& inputs) {
  using enum exact::DiffuseModel;
  const int steps = inputs.config["steps"];
  std::vector<double> angles;
  for (int i = 0; i <= steps; ++i) angles.push_back(0.5 * std::numbers::pi * i / steps);
  const std::vector<Series> all = {
      formula("meder-bruederlin, α = 31.7003", "meder-bruederlin", "formula", angles,
              [](double c) { return meder_difference(c, 31.7003); }),
      formula("tokuyoshi2022", "tokuyoshi2022", "formula", angles, tokuyoshi_difference),
      on_device(inputs, meder_bruederlin, angles), on_device(inputs, tokuyoshi2022, angles),
      formula("meder-bruederlin, α = 31.703 as printed", "meder-bruederlin", "published", angles,
              [](double c) { return meder_difference(c, 31.703); })};

  FigureOutput out;
  FigureTable table{"sgl22-2", {"approximation", "origin", "angle_deg", "difference"}, {}};
  const PlotAxis x{"angle between ω and n / degrees"};
  Plot plot{.title = "SG approximations minus the clamped cosine", .x = x, .y = {"difference"}};
  Plot closeup{.title = "The same, close up", .x = x, .y = {"difference"}};
  for (const Series& s : all) {
    for (size_t i = 0; i < angles.size(); ++i) {
      table.add(s.approximation, s.origin, angles[i] * 180 / std::numbers::pi, s.differences[i]);
    }
    plot.curves.push_back(curve_of(s, angles));
    if (s.approximation == name(tokuyoshi2022)) closeup.curves.push_back(plot.curves.back());
  }
  plot.notes = {"Formulas in double precision. The GPU's values are of L(v,κ), held to [0,1]."};
  closeup.notes = plot.notes;
  set_size(inputs.config, &plot);
  set_size(inputs.config, &closeup);
  out.tables = {table, parameters()};
  out.plots = {{"sgl22-2", plot}, {"sgl22-2-closeup", closeup}};
  const double found = least_argument(1e-6, 1e-1, error_bound);
  out.claims = {
      {"the approximation has a significantly smaller error than the previous one", "[SGL22] Fig. 2",
       finding(largest(all[1]) < 0.1 * largest(all[0])),
       fmt::format("largest difference {:.3g} against {:.3g}", largest(all[1]), largest(all[0]))},
      {"minimising the error bound gives λ = 0.00084560872", "[SGL22] §2",
       finding(square(found / kPublishedLambda - 1) < square(1e-3)), fmt::format("λ = {:.6g}", found)}};
  return out;
}

}  // namespace vsglbench::sgl22
