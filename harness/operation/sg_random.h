// Random arguments over the whole domain of an operation, what its errors come to, and failures made small.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "operation/sg_evaluation.h"

namespace vsglbench {

// `count` rows. Sharpnesses are log-uniform in [1e-6, 2^41], some 0 and some at the bound; of the cosines
// half are uniform, the others crowd towards 0 and ±1 or are there. SG × ASG: the axis is where the result is
// no 0. Shading: half of the lights are near the mirror direction, most lobes where they give light.
std::vector<float> random_rows(const SgQuestion& question, size_t count, uint64_t seed);

struct ErrorSpread {
  double p50 = 0, p99 = 0, max = 0;  // of the rows whose value is finite
  size_t worst = 0;                  // row of the largest
  std::vector<size_t> impossible;    // rows that impossible() complains of
};
ErrorSpread error_spread(const SgQuestion& question, const SgAnswers& answers);

// A row that is impossible still, of numbers as short to write as could be found.
std::vector<float> shrink(SgEvaluator& evaluator, std::vector<float> row);
// The command that shows it.
std::string reproducer(const SgQuestion& question, const std::vector<float>& row);

}  // namespace vsglbench
