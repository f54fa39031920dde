// What each function of sg_eval.comp takes and gives.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/nearest.h"
#include "operation/sg_evaluation.h"
#include "operation/sg_receiver.h"
#include "operation/sg_shade.h"

namespace vsglbench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSharpest = 0x1p41;

}  // namespace

const std::vector<SgFunctionInfo>& sg_functions() {
  using enum SgError;
  static const std::vector<std::string> asg = {"axis_x", "axis_y", "axis_z", "sharpness", "eta_x", "eta_y"};
  static const std::vector<SgFunctionInfo> all = {
      {"clamped_cosine",
       {"cosine", "sharpness"},
       {"value"},
       absolute,
       0,
       1,
       "L(v,κ) = ∫G max(ω·n,0)/∫G by --model, against quadrature; cosine = v·n"},
      {"integral", {"sharpness"}, {"value"}, relative, 0, kInfinity, "A(λ), the integral of an SG"},
      {"product",
       {"cosine", "sharpness1", "sharpness2"},
       {"log_amplitude", "sharpness"},
       relative,
       -kInfinity,
       0,
       "product of two SGs with this cosine between their axes"},
      {"hemisphere",
       {"cosine", "sharpness"},
       {"value"},
       absolute,
       0,
       1,
       "s(v·n,κ), the normalised hemispherical integral: --model meder-bruederlin or tokuyoshi2022"},
      {"asg_product",
       asg,
       {"value"},
       relative,
       0,
       kInfinity,
       "∫ SG × ASG of an SG with this axis in the ASG's frame; exponent in twice the precision"},
      {"toksvig_roundtrip", {"sharpness"}, {"value"}, of_one_more, 0, kInfinity, "λ to 1-r and back"},
      {"value",
       {"cosine", "sharpness"},
       {"value"},
       absolute,
       0,
       1,
       "G(ω;ξ,λ) of a direction at this cosine from the axis"},
      {"banerjee", {"complement"}, {"value"}, of_one_more, 0, kInfinity, "κ of a vMF lobe from 1-r"},
      {"vmf_complement", {"sharpness"}, {"value"}, relative, 0, 1, "1-r of a vMF lobe"},
      {"erf", {"x"}, {"value"}, relative, -1, 1, "the error function"},
      {"erfc", {"x"}, {"value"}, exponential, 0, 2, "its complement"},
      {"expm1_over_x", {"x"}, {"value"}, relative, 0, kInfinity, "(e^x-1)/x"},
      {"exp", {"x"}, {"value"}, relative, 0, kInfinity, "e^x"},
      {"asg_product_shading",
       asg,
       {"value"},
       exponential,
       0,
       kInfinity,
       "asg_product as the pixels evaluate it"},
      {"shade",
       sg_shade::columns(),
       {"value"},
       conditioned,
       0,
       kInfinity,
       "reflected radiance of a whole VSGL at a whole surface, with the diffuse term by --model"},
      {"receiver",
       sg_receiver::columns(),
       {"value"},
       relative,
       0,
       kInfinity,
       "specular reflection of an SG at an angle from the mirror direction (degrees; plane 0 and 180 in the "
       "plane of "
       "incidence, 90 across), against cubature of the exact BRDF; without --in and --random its table"},
  };
  return all;
}

const char* error_name(SgError error) {
  switch (error) {
    case SgError::absolute:
      return "abs_error";
    case SgError::relative:
      return "rel_error";
    case SgError::of_one_more:
      return "error_over_1_plus_exact";
    case SgError::exponential:
      return "rel_error_over_1_plus_exponent";
    case SgError::conditioned:
      return "error_over_condition";
  }
  return "";
}

SgFunction sg_function(const std::string& name) {
  std::vector<std::string> names;
  for (const auto& f : sg_functions()) {
    if (f.name == name) return static_cast<SgFunction>(names.size());
    names.push_back(f.name);
  }
  throw fail(ErrorKind::usage, "no function '{}'{}", name, suggestion(name, names));
}

exact::DiffuseModel diffuse_model(const std::string& name) {
  const auto& names = exact::diffuse_model_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<exact::DiffuseModel>(found - names.begin());
  throw fail(ErrorKind::usage, "no diffuse model '{}'{}", name, suggestion(name, names));
}

std::pair<double, double> sg_domain(const SgQuestion& q, const std::string& column) {
  if (q.function == SgFunction::shade) return sg_shade::domain(column);
  if (q.function == SgFunction::receiver) return sg_receiver::domain(column);
  if (column == "cosine" || column == "axis_x" || column == "axis_y") return {-1, 1};
  if (column == "axis_z") return {0, 1};
  if (column == "complement") return {0x1p-41, 1};
  if (column.starts_with("eta")) return {1e-6f, kSharpest};
  if (column == "x") {
    return q.function == SgFunction::exp || q.function == SgFunction::expm1_over_x ? std::pair(-0x1p42, 88.0)
                                                                                   : std::pair(-100.0, 100.0);
  }
  const bool diverges =
      q.function == SgFunction::clamped_cosine && q.model == exact::DiffuseModel::pettineo_hill;
  return {diverges ? 1e-6f : 0, kSharpest};
}

std::string out_of_domain(const SgQuestion& q, std::span<const float> row) {
  const auto& columns = q.info().columns;
  double norm2 = 0;
  for (size_t k = 0; k < columns.size(); ++k) {
    if (q.function == SgFunction::shade) {
      if (std::string what = sg_shade::out_of_domain(columns[k], row[k]); !what.empty()) return what;
      continue;
    }
    if (q.function == SgFunction::receiver) {
      if (std::string what = sg_receiver::out_of_domain(columns[k], row[k]); !what.empty()) return what;
      continue;
    }
    const auto [least, most] = sg_domain(q, columns[k]);
    if (!(row[k] >= least && row[k] <= most)) {
      return fmt::format("{} is {}, not in [{}, {}]", columns[k], row[k], static_cast<float>(least),
                         static_cast<float>(most));
    }
    if (columns[k].starts_with("axis")) norm2 += static_cast<double>(row[k]) * row[k];
  }
  const bool axis = columns[0] == "axis_x";
  return axis && std::abs(norm2 - 1) > 1e-4
             ? fmt::format("the axis has length {:.4g}, not 1", std::sqrt(norm2))
             : "";
}

std::string impossible(const SgQuestion& q, const SgAnswers& answers, size_t i) {
  const double value = answers.values[i * answers.results];
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return "infinite";
  if (value < q.info().least)
    return q.info().least == 0 ? "negative" : fmt::format("below {}", q.info().least);
  return value > q.info().most ? fmt::format("above {}", q.info().most) : "";
}

}  // namespace vsglbench
