// One hard case tried with one method: its cells.
#pragma once

#include "stability/hard_cases.h"
#include "stability/made_shading.h"
#include "stability/stability.h"

namespace vsglbench {

class Trial {
 public:
  // `diffuse`: names of diffuse models; the first is that of cases that ask for one.
  Trial(KernelLibrary& kernels, std::vector<std::string> diffuse)
      : kernels_(kernels), shading_(kernels), diffuse_(std::move(diffuse)) {}

  // What the method throws is a cell, but for a lost device: Error(device_lost).
  std::vector<StabilityCell> run(const HardCase& hard_case, const StabilityRow& row);

 private:
  std::vector<std::string> models_of(const HardCase& hard_case, const StabilityRow& row) const;
  std::vector<StabilityCell> run_half(const HardCase& hard_case, const StabilityRow& row,
                                      const MethodInfo& method);
  StabilityCell run_scene(const HardCase& hard_case, const StabilityRow& row, const MethodInfo& method,
                          const std::string& diffuse);
  KernelLibrary& kernels_;
  MadeShading shading_;
  std::vector<std::string> diffuse_;
};

}  // namespace vsglbench
