#include "measure/sg_evaluation.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include "base/error.h"
#include "base/file.h"
#include "base/nearest.h"

namespace vsglbench {
namespace {

using glm::dvec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLeastNormal = std::numeric_limits<float>::min();
constexpr double kSharpest = 0x1p41;
constexpr size_t kChunkRows = 1 << 18, kGroup = 64;

double banerjee(double complement) { return exact::banerjee_sharpness(std::max(complement, 0x1p-41)); }

// Columns as the device has them: two axes for the cosine between them.
size_t device_columns(const SgQuestion& q) {
  const bool axes = q.function == SgFunction::product || q.function == SgFunction::value;
  return axes ? 8 : q.info().columns.size();
}

// Axes with this cosine between them, as good as single precision holds them, that no coordinate plane
// favours.
void append_axes(float cosine, float sharpness1, float sharpness2, std::vector<float>* out) {
  const dvec3 a = glm::normalize(dvec3(0.48, -0.6, 0.64)),
              b = glm::normalize(glm::cross(a, dvec3(0.2, 0.9, 0.3)));
  const double c = cosine, s = std::sqrt((1 - c) * (1 + c));
  const dvec3 second = c * a + s * b;
  for (int k = 0; k < 3; ++k) out->push_back(static_cast<float>(a[k]));
  out->push_back(sharpness1);
  for (int k = 0; k < 3; ++k) out->push_back(static_cast<float>(second[k]));
  out->push_back(sharpness2);
}

void append_arguments(const SgQuestion& q, std::span<const float> row, std::vector<float>* out) {
  if (q.function == SgFunction::product) return append_axes(row[0], row[1], row[2], out);
  if (q.function == SgFunction::value) return append_axes(row[0], 0, row[1], out);
  out->insert(out->end(), row.begin(), row.end());
}

// What the device should have made of these arguments.
void exact_results(const SgQuestion& q, const float* a, double* out) {
  const auto vector = [a](int i) { return dvec3(a[i], a[i + 1], a[i + 2]); };
  switch (q.function) {
    case SgFunction::clamped_cosine:
      out[0] = exact::clamped_cosine(a[0], a[1]);
      return;
    case SgFunction::integral:
      out[0] = exact::sg_integral(a[0]);
      return;
    case SgFunction::product: {
      const exact::SgProduct p = exact::sg_product(vector(0), a[3], vector(4), a[7]);
      out[0] = p.log_amplitude;
      out[1] = p.sharpness;
      return;
    }
    case SgFunction::hemisphere:
      out[0] = exact::normalized_hemisphere(a[0], a[1]);
      return;
    case SgFunction::asg_product:
    case SgFunction::asg_product_shading:
      out[0] = exact::asg_product(vector(0), a[3], a[4], a[5]);
      return;
    case SgFunction::toksvig_roundtrip:
      out[0] = a[0];
      return;
    case SgFunction::value:
      out[0] = exact::sg_value(vector(0), vector(4), a[7]);
      return;
    case SgFunction::banerjee:
      out[0] = banerjee(a[0]);
      return;
    case SgFunction::vmf_complement:
      out[0] = exact::vmf_complement(a[0]);
      return;
    case SgFunction::erf:
      out[0] = std::erf(static_cast<double>(a[0]));
      return;
    case SgFunction::erfc:
      out[0] = std::erfc(static_cast<double>(a[0]));
      return;
    case SgFunction::expm1_over_x:
      out[0] = exact::expm1_over_x(a[0]);
      return;
    case SgFunction::exp:
      out[0] = std::exp(static_cast<double>(a[0]));
      return;
  }
}

double error_of(SgError kind, double value, double exact) {
  const double difference = std::abs(value - exact), size = std::abs(exact);
  if (kind == SgError::absolute) return difference;
  if (kind == SgError::of_one_more) return difference / (1 + size);
  if (size < kLeastNormal) return std::abs(value) <= 2 * kLeastNormal ? 0 : difference / kLeastNormal;
  return difference / size / (kind == SgError::exponential ? 1 + std::abs(std::log(size)) : 1);
}

// Calls work(i) for i in [0, count) on all cores, some at a time.
template <class Work>
void on_all_cores(size_t count, const Work& work) {
  constexpr size_t kPart = 256;
  std::atomic<size_t> next = 0;
  const auto take = [&] {
    for (size_t from; (from = next.fetch_add(kPart)) < count;) {
      for (size_t i = from; i < std::min(from + kPart, count); ++i) work(i);
    }
  };
  std::vector<std::jthread> others;
  for (unsigned t = 1; t < std::thread::hardware_concurrency(); ++t) others.emplace_back(take);
  take();
}

std::filesystem::path or_default(const std::filesystem::path& kernel) {
  return kernel.empty() ? data_root() / "harness" / "measure" / "sg_eval.comp" : kernel;
}

ShaderDefines defines(const SgQuestion& q) {
  return {{"FUNCTION", std::to_string(static_cast<int>(q.function))},
          {"DIFFUSE_KERNEL", std::to_string(static_cast<int>(q.kernel))},
          {"COLUMNS", std::to_string(device_columns(q))},
          {"RESULTS", std::to_string(q.info().results.size())}};
}

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
       "L(v,κ) = ∫G max(ω·n,0)/∫G by --kernel, against quadrature; cosine = v·n"},
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
       "s(v·n,κ), the normalised hemispherical integral: --kernel meder-bruederlin or tokuyoshi2022"},
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

exact::DiffuseKernel diffuse_kernel(const std::string& name) {
  const auto& names = exact::diffuse_kernel_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<exact::DiffuseKernel>(found - names.begin());
  throw fail(ErrorKind::usage, "no diffuse kernel '{}'{}", name, suggestion(name, names));
}

std::pair<double, double> sg_domain(const SgQuestion& q, const std::string& column) {
  if (column == "cosine" || column == "axis_x" || column == "axis_y") return {-1, 1};
  if (column == "axis_z") return {0, 1};
  if (column == "complement") return {0x1p-41, 1};
  if (column.starts_with("eta")) return {1e-6f, kSharpest};
  if (column == "x") {
    return q.function == SgFunction::exp || q.function == SgFunction::expm1_over_x ? std::pair(-0x1p42, 88.0)
                                                                                   : std::pair(-100.0, 100.0);
  }
  const bool diverges =
      q.function == SgFunction::clamped_cosine && q.kernel == exact::DiffuseKernel::pettineo_hill;
  return {diverges ? 1e-6f : 0, kSharpest};
}

std::string out_of_domain(const SgQuestion& q, std::span<const float> row) {
  const auto& columns = q.info().columns;
  double norm2 = 0;
  for (size_t k = 0; k < columns.size(); ++k) {
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

SgEvaluator::SgEvaluator(Device& device, const SgQuestion& question, const std::filesystem::path& kernel)
    : kernels_(device),
      recorder_(device),
      question_(question),
      kernel_(kernels_.get(or_default(kernel), defines(question))) {}

std::vector<float> SgEvaluator::on_device(std::span<const float> arguments) {
  const auto rows = static_cast<uint32_t>(arguments.size() / device_columns(question_));
  const size_t results = rows * question_.info().results.size();
  Buffer in(recorder_.device(), "arguments", arguments.size_bytes());
  Buffer out(recorder_.device(), "values", results * sizeof(float));
  in.upload(arguments);
  recorder_.begin();
  recorder_.pass("sg", [&] { recorder_.dispatch(kernel_, {in, out}, rows, groups_for(rows, kGroup)); });
  recorder_.submit_and_wait();
  return out.download<float>(results);
}

SgAnswers SgEvaluator::evaluate(std::span<const float> rows) {
  const size_t columns = question_.info().columns.size(), wide = device_columns(question_);
  const size_t count = rows.size() / columns;
  SgAnswers a;
  a.results = question_.info().results.size();
  a.exact.resize(count * a.results);
  a.error.resize(count);
  for (size_t from = 0; from < count; from += kChunkRows) {
    const size_t part = std::min(kChunkRows, count - from);
    std::vector<float> arguments;
    for (size_t i = from; i < from + part; ++i) {
      append_arguments(question_, rows.subspan(i * columns, columns), &arguments);
    }
    const std::vector<float> values = on_device(arguments);
    a.values.insert(a.values.end(), values.begin(), values.end());
    on_all_cores(part, [&](size_t i) {
      const size_t at = (from + i) * a.results;
      exact_results(question_, &arguments[i * wide], &a.exact[at]);
      a.error[from + i] = error_of(question_.info().error, a.values[at], a.exact[at]);
    });
  }
  return a;
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
