// The verdicts of a page, held against those of an earlier one.
#pragma once

#include <string>
#include <vector>

#include "base/json.h"
#include "papers/trial.h"

namespace vsglbench {

struct Flip {
  ClaimTrial before, after;
  bool lost =
      false;  // what held no longer does, or what did not hold does: a kernel has changed what is true
};

struct Flips {
  std::vector<Flip> changed;
  size_t compared = 0;  // trials that both have at one scale
  size_t vanished = 0;  // of `before`, that an exhibit of `after` of the same scale has no more
};

// Trials whose rulings differ. `lost`: both rulings are certain, that is neither undecided nor not run.
Flips flips(const Json& before, const Json& after);

// "[MFIS16 §5] no longer holds: ... (mfis16-fig5, conference, rmse; 0.98 [0.97, 0.99] was, 1.2 [1.1, 1.3]
// is)"
std::string flip_text(const Flip& flip);

}  // namespace vsglbench
