#include "figure/kernel_times.h"

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

KernelTimes::KernelTimes(std::vector<std::vector<double>> by_kernel, std::vector<double> twin)
    : ms_(std::move(by_kernel)), measurable_(std::ranges::all_of(ms_, all_positive) && all_positive(twin)) {
  if (measurable_) noise_ = noise_floor(median_ratio(of(exact::DiffuseKernel::tokuyoshi2022), twin));
}

Finding KernelTimes::faster(exact::DiffuseKernel a, exact::DiffuseKernel b) const {
  if (!measurable_) return Finding::undecided;
  const Verdict verdict = compare_times(of(a), of(b), noise_);
  return verdict == Verdict::ambiguous ? Finding::undecided : finding(verdict == Verdict::faster);
}

std::string KernelTimes::figures(const std::vector<exact::DiffuseKernel>& kernels) const {
  std::string out;
  for (const auto kernel : kernels) {
    const Summary s = summarize(of(kernel));
    out += fmt::format("{} {:.4g} ms, 95 % [{:.4g}, {:.4g}]; ", name(kernel), s.median, s.ci95.lo, s.ci95.hi);
  }
  return out + fmt::format("A/A noise {:.2g} %", 100 * noise_);
}

Finding both(Finding a, Finding b) {
  if (a == Finding::does_not_hold || b == Finding::does_not_hold) return Finding::does_not_hold;
  return a == b ? a : Finding::undecided;
}

}  // namespace vsglbench::sgl22
