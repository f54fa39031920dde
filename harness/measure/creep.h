// Changes that no two reports beside each other show: a series that creeps.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "measure/verdict.h"

namespace vsglbench {

// So many figures at either end of a stretch are held against each other. Of figures that are noise alone,
// whatever its size, three stretches in a million have ends that lie apart as creep_of() asks.
inline constexpr size_t kCreepEnd = 15;

struct Creep {
  // Figures between which it crept: from the first on, the median of the kCreepEnd figures round each stays
  // beyond a quarter of the change, and from the second on beyond three quarters.
  size_t from = 0, to = 0;
  Ratio ratio;  // of the last kCreepEnd figures over the first
};

// Figures of a stretch without a step, in their order. It creeps where its last kCreepEnd figures, but for
// one, lie beyond those that it began with, but for one, by more than `noise` (relative), all on one side.
// What has come back does not creep, nor what is shorter than both ends, nor what has a figure that is not
// above 0.
std::optional<Creep> creep_of(std::span<const double> figures, double noise);

}  // namespace vsglbench
