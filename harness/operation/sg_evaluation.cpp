#include "operation/sg_evaluation.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include "base/file.h"
#include "operation/sg_receiver.h"
#include "operation/sg_shade.h"

namespace vsglbench {
namespace {

using glm::dvec3;

constexpr double kLeastNormal = std::numeric_limits<float>::min();
constexpr size_t kChunkRows = 1 << 18, kGroup = 64;

double banerjee(double complement) { return exact::banerjee_sharpness(std::max(complement, 0x1p-41)); }

// Columns as the device has them: two axes for the cosine between them.
size_t device_columns(const SgQuestion& q) {
  if (q.function == SgFunction::shade) return sg_shade::kDeviceColumns;
  if (q.function == SgFunction::receiver) return sg_receiver::kDeviceColumns;
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
  if (q.function == SgFunction::shade) return sg_shade::append_arguments(row, out);
  if (q.function == SgFunction::receiver) return sg_receiver::append_arguments(row, out);
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
    case SgFunction::receiver:
      out[0] = sg_receiver::integral(a);
      return;
    case SgFunction::shade:  // in error_of_shade(), with its condition
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

// The error of one row; the exact value goes to *exact.
double error_of_shade(const SgQuestion& q, const float* arguments, double value, double* exact) {
  const sg_shade::Answer answer = sg_shade::answer(arguments, q.model);
  *exact = answer.value;
  const double difference = std::max(std::abs(value - answer.value) - answer.floor, 0.0);  // a NaN stays one
  return difference > 0 ? difference / answer.scale : difference;
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
  return kernel.empty() ? data_root() / "harness" / "operation" / "sg_eval.comp" : kernel;
}

ShaderDefines defines(const SgQuestion& q) {
  return {{"FUNCTION", std::to_string(static_cast<int>(q.function))},
          {"DIFFUSE_MODEL", std::to_string(static_cast<int>(q.model))},
          {"COLUMNS", std::to_string(device_columns(q))},
          {"RESULTS", std::to_string(q.info().results.size())}};
}

}  // namespace

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
  recorder_.pass({.step = "sg"}, [&] {
    recorder_.dispatch(kernel_, {in, out}, rows, groups_for(rows, kGroup));
  });
  recorder_.submit_and_wait();
  return out.download<float>(results);
}

std::vector<float> SgEvaluator::values(std::span<const float> rows) {
  const size_t columns = question_.info().columns.size(), count = rows.size() / columns;
  std::vector<float> all;
  for (size_t from = 0; from < count; from += kChunkRows) {
    std::vector<float> arguments;
    for (size_t i = from; i < std::min(from + kChunkRows, count); ++i) {
      append_arguments(question_, rows.subspan(i * columns, columns), &arguments);
    }
    const std::vector<float> part = on_device(arguments);
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

SgAnswers SgEvaluator::evaluate(std::span<const float> rows) {
  const size_t columns = question_.info().columns.size(), count = rows.size() / columns;
  SgAnswers a;
  a.results = question_.info().results.size();
  a.values = values(rows);
  a.exact.resize(count * a.results);
  a.error.resize(count);
  on_all_cores(count, [&](size_t i) {
    std::vector<float> arguments;
    append_arguments(question_, rows.subspan(i * columns, columns), &arguments);
    const size_t at = i * a.results;
    if (question_.function == SgFunction::shade) {
      a.error[i] = error_of_shade(question_, arguments.data(), a.values[at], &a.exact[at]);
      return;
    }
    exact_results(question_, arguments.data(), &a.exact[at]);
    a.error[i] = error_of(question_.info().error, a.values[at], a.exact[at]);
  });
  return a;
}

}  // namespace vsglbench
