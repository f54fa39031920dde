#include "figure/model_times.h"

#include <fmt/format.h>

#include <algorithm>

#include "figure/sgl22.h"
#include "measure/verdict.h"

namespace vsglbench::sgl22 {
namespace {

bool all_positive(const std::vector<double>& times) {
  return std::ranges::all_of(times, [](double t) { return t > 0; });
}

}  // namespace

ModelTimes::ModelTimes(std::vector<std::vector<double>> by_model, std::vector<double> twin)
    : ms_(std::move(by_model)), measurable_(std::ranges::all_of(ms_, all_positive) && all_positive(twin)) {
  if (measurable_) noise_ = noise_floor(median_ratio(of(exact::DiffuseModel::tokuyoshi2022), twin));
}

Finding ModelTimes::faster(exact::DiffuseModel a, exact::DiffuseModel b) const {
  if (!measurable_) return Finding::undecided;
  const Verdict verdict = compare_times(of(a), of(b), noise_);
  return verdict == Verdict::ambiguous ? Finding::undecided : finding(verdict == Verdict::faster);
}

std::string ModelTimes::figures(const std::vector<exact::DiffuseModel>& models) const {
  std::string out;
  for (const auto model : models) {
    const Summary s = summarize(of(model));
    out += fmt::format("{} {:.4g} ms, 95 % [{:.4g}, {:.4g}]; ", name(model), s.median, s.ci95.lo, s.ci95.hi);
  }
  return out + fmt::format("A/A noise {:.2g} %", 100 * noise_);
}

Finding both(Finding a, Finding b) {
  if (a == Finding::does_not_hold || b == Finding::does_not_hold) return Finding::does_not_hold;
  return a == b ? a : Finding::undecided;
}

}  // namespace vsglbench::sgl22
