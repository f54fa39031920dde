// One operation of harness/shaders on rows of arguments: in single precision on the device, and in double
// precision on the host on the same single-precision arguments.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "gpu/recorder.h"
#include "method/context.h"
#include "shaders/sg_exact.h"

namespace vsglbench {

// Numbered as FUNCTION in sg_eval.comp.
enum class SgFunction {
  clamped_cosine,
  integral,
  product,
  hemisphere,
  asg_product,
  toksvig_roundtrip,
  value,
  banerjee,
  vmf_complement,
  erf,
  erfc,
  expm1_over_x,
  exp,
  asg_product_shading,
  shade,
  receiver,
};

// How far a value is from the exact one: |difference|; that over |exact|; that over 1+|exact|; or over
// |exact| times 1 + the exponent that exact = e^{-exponent} has; or over the scale of sg_shade.h, which has
// the condition of the problem in it. Where |exact| is below single precision's normal numbers, 0 is as good
// as it.
enum class SgError { absolute, relative, of_one_more, exponential, conditioned };

struct SgFunctionInfo {
  std::string name;
  std::vector<std::string> columns;  // of a row of arguments
  std::vector<std::string> results;  // the error is that of the first
  SgError error = SgError::relative;
  double least = 0, most = 0;  // the first result can't lie outside
  std::string meaning;
};
const std::vector<SgFunctionInfo>& sg_functions();  // in the order of SgFunction
const char* error_name(SgError error);

struct SgQuestion {
  SgFunction function = SgFunction::clamped_cosine;
  exact::DiffuseModel model = exact::DiffuseModel::cosine;  // where has_model()
  bool has_model() const {
    using enum SgFunction;
    return function == clamped_cosine || function == hemisphere || function == shade;
  }
  const std::string& model_name() const { return exact::diffuse_model_names()[static_cast<size_t>(model)]; }
  const SgFunctionInfo& info() const { return sg_functions()[static_cast<size_t>(function)]; }
};

// Both throw Error(usage) naming the nearest.
SgFunction sg_function(const std::string& name);
exact::DiffuseModel diffuse_model(const std::string& name);
// The interval that a column's values must lie in.
std::pair<double, double> sg_domain(const SgQuestion& question, const std::string& column);
// What makes a row no argument of the function, "cosine is 2, not in [-1, 1]"; empty: nothing.
std::string out_of_domain(const SgQuestion& question, std::span<const float> row);

struct SgAnswers {
  size_t results = 1;         // a row
  std::vector<float> values;  // row-major
  std::vector<double> exact;  // row-major; clamped_cosine, hemisphere and receiver by quadrature
  std::vector<double> error;  // one a row; NaN where the value is
};

class SgEvaluator {
 public:
  // `kernel`: another file than sg_eval.comp, with its interface.
  SgEvaluator(Device& device, const SgQuestion& question, const std::filesystem::path& kernel = {});
  const SgQuestion& question() const { return question_; }
  // rows.size() / columns rows, row-major, each within its domain; in chunks that fit the device.
  SgAnswers evaluate(std::span<const float> rows);
  // The device's results alone, row-major.
  std::vector<float> values(std::span<const float> rows);

 private:
  std::vector<float> on_device(std::span<const float> arguments);
  KernelLibrary kernels_;
  Recorder recorder_;
  SgQuestion question_;
  const Kernel& kernel_;
};

// Why the first result of row i is impossible: "NaN", "infinite", "negative", "above 1"; empty: it is not.
std::string impossible(const SgQuestion& question, const SgAnswers& answers, size_t i);

}  // namespace vsglbench
