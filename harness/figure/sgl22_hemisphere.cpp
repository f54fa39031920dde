// [SGL22] Fig. 3: root mean square error, over the cosine v·n in [-1,1], of two approximations of the
// normalised hemispherical integral s(v·n,κ), by sharpness κ.
#include <fmt/format.h>

#include <cmath>

#include "figure/sgl22.h"
#include "operation/sg_evaluation.h"

namespace vsglbench::sgl22 {
namespace {

struct Approximation {
  const char* name;
  exact::DiffuseModel model;  // whose hemispherical integral it is
  double (*formula)(double cosine, double sharpness);
};

const Approximation kLogistic = {"logistic (Meder and Brüderlin)", exact::DiffuseModel::meder_bruederlin,
                                 exact::logistic_hemisphere};
const Approximation kGaussian = {"[SGL22] Eq. 1", exact::DiffuseModel::tokuyoshi2022,
                                 exact::gaussian_hemisphere};

// Largest sharpness from which on the paper's "large" is taken to begin.
constexpr double kLarge = 8;

std::vector<double> sharpnesses(const Json& config) {
  const double least = config["least"], most = config["most"];
  const int steps = config["steps"];
  std::vector<double> out;
  // As the device has them: single precision.
  for (int i = 0; i <= steps; ++i) {
    out.push_back(static_cast<float>(least * std::pow(most / least, static_cast<double>(i) / steps)));
  }
  return out;
}

// RMSE of every sharpness from values row by row, `cosines` rows each.
template <class Value>
std::vector<double> rmse(const std::vector<double>& exact, size_t cosines, const Value& value) {
  std::vector<double> out;
  for (size_t from = 0; from < exact.size(); from += cosines) {
    double sum = 0;
    for (size_t i = from; i < from + cosines; ++i) sum += std::pow(value(i) - exact[i], 2);
    out.push_back(std::sqrt(sum / static_cast<double>(cosines)));
  }
  return out;
}

Claim small_claim(const std::vector<double>& previous, const std::vector<double>& ours) {
  size_t below = 0;
  for (size_t i = 0; i < ours.size(); ++i) below += ours[i] < previous[i];
  return {"the error is smaller than the logistic approximation's in most cases, even for small κ",
          "[SGL22] §3", finding(2 * below > ours.size()),
          fmt::format("at {} of {} sharpnesses", below, ours.size())};
}

Claim large_claim(const std::vector<double>& kappa, const std::vector<double>& previous,
                  const std::vector<double>& ours) {
  Claim claim{"the error is smaller for large sharpness", "[SGL22] Fig. 3", Finding::holds,
              fmt::format("at all κ >= {}", kLarge)};
  for (size_t i = 0; i < kappa.size(); ++i) {
    if (kappa[i] < kLarge || ours[i] < previous[i]) continue;
    claim.finding = Finding::does_not_hold;
    claim.figures = fmt::format("{:.3g} against {:.3g} at κ = {:.3g}", ours[i], previous[i], kappa[i]);
  }
  return claim;
}

}  // namespace

FigureOutput hemisphere(const FigureInputs& inputs) {
  const std::vector<double> kappa = sharpnesses(inputs.config);
  const size_t cosines = inputs.config["cosines"];
  std::vector<float> rows;
  for (const double k : kappa) {
    for (size_t i = 0; i < cosines; ++i) {
      rows.push_back(-1 + 2 * static_cast<float>(i) / static_cast<float>(cosines - 1));
      rows.push_back(static_cast<float>(k));
    }
  }

  FigureOutput out;
  FigureTable table{"sgl22-3", {"approximation", "origin", "sharpness", "rmse"}, {}};
  Plot plot{.title = "Normalised hemispherical integral of an SG",
            .x = {"sharpness κ", true},
            .y = {"RMSE over v·n", true},
            .notes = {fmt::format("{} cosines a sharpness; single precision on the GPU against quadrature.",
                                  cosines)}};
  std::vector<double> exact;
  std::vector<std::vector<double>> measured;
  for (const Approximation& a : {kLogistic, kGaussian}) {
    SgEvaluator evaluator(inputs.device, {SgFunction::hemisphere, a.model});
    inputs.begin(fmt::format("{} values of {}", rows.size() / 2, a.name));
    if (exact.empty()) exact = evaluator.evaluate(rows).exact;
    const std::vector<float> values = evaluator.values(rows);
    const auto on_device = rmse(exact, cosines, [&](size_t i) { return static_cast<double>(values[i]); });
    const auto formula =
        rmse(exact, cosines, [&](size_t i) { return a.formula(rows[2 * i], rows[2 * i + 1]); });
    Curve curve{a.name, {}};
    for (size_t i = 0; i < kappa.size(); ++i) {
      table.add(std::string(a.name), std::string("measured"), kappa[i], on_device[i]);
      table.add(std::string(a.name), std::string("formula"), kappa[i], formula[i]);
      curve.points.push_back({kappa[i], on_device[i]});
    }
    plot.curves.push_back(std::move(curve));
    measured.push_back(on_device);
  }
  set_size(inputs.config, &plot);
  out.tables = {table};
  out.plots = {{"sgl22-3", plot}};
  out.claims = {large_claim(kappa, measured[0], measured[1]), small_claim(measured[0], measured[1])};
  return out;
}

}  // namespace vsglbench::sgl22
