// Which diffuse model is the faster, as far as the noise lets one tell.
#pragma once

#include <string>
#include <vector>

#include "figure/figure.h"
#include "shaders/sg_exact.h"

namespace vsglbench::sgl22 {

// Times of frames that took turns, ms. `twin`: of a second frame with the model tokuyoshi2022; what the two
// differ by is noise (A/A).
class ModelTimes {
 public:
  ModelTimes() = default;
  ModelTimes(std::vector<std::vector<double>> by_model, std::vector<double> twin);

  const std::vector<double>& of(exact::DiffuseModel model) const {
    return ms_.at(static_cast<size_t>(model));
  }
  // Whether `a` takes less time than `b` (measure/verdict.h). Undecided, too, where the device's clock shows
  // nothing for a frame.
  Finding faster(exact::DiffuseModel a, exact::DiffuseModel b) const;
  // Medians with their intervals, and the noise.
  std::string figures(const std::vector<exact::DiffuseModel>& models) const;

 private:
  std::vector<std::vector<double>> ms_;
  bool measurable_ = false;
  double noise_ = 0;  // as noise_floor()
};

// Holds where both do; does not where one does not.
Finding both(Finding a, Finding b);

}  // namespace vsglbench::sgl22
