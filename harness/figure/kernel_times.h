// Which diffuse kernel is the faster, as far as the noise lets one tell.
#pragma once

#include <string>
#include <vector>

#include "figure/figure.h"
#include "shaders/sg_exact.h"

namespace vsglbench::sgl22 {

// Times of frames that took turns, ms. `twin`: of a second frame with the kernel tokuyoshi2022; what the two
// differ by is noise (A/A).
class KernelTimes {
 public:
  KernelTimes() = default;
  KernelTimes(std::vector<std::vector<double>> by_kernel, std::vector<double> twin);

  const std::vector<double>& of(exact::DiffuseKernel kernel) const {
    return ms_.at(static_cast<size_t>(kernel));
  }
  // Whether `a` takes less time than `b` (measure/verdict.h). Undecided, too, where the device's clock shows
  // nothing for a frame.
  Finding faster(exact::DiffuseKernel a, exact::DiffuseKernel b) const;
  // Medians with their intervals, and the noise.
  std::string figures(const std::vector<exact::DiffuseKernel>& kernels) const;

 private:
  std::vector<std::vector<double>> ms_;
  bool measurable_ = false;
  double noise_ = 0;  // as noise_floor()
};

// Holds where both do; does not where one does not.
Finding both(Finding a, Finding b);

}  // namespace vsglbench::sgl22
