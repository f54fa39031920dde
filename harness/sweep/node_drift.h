// How far the nodes of one sweep are apart: what its anchor, the same case in every block of a scene, took in
// each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/verdict.h"

namespace vsglbench {

struct AnchorRun {
  size_t shard = 0;
  std::string where;             // node, or host
  std::vector<double> times_ms;  // of the method, one a frame
};

// Of the block that is farthest from the first.
struct NodeDrift {
  std::string scene, anchor;
  size_t blocks = 0;
  AnchorRun first, farthest;    // without their samples
  Ratio ratio;                  // of medians, farthest / first
  std::optional<double> noise;  // A/A, of the scene; nothing: not known
  // The interval lies wholly beyond the noise: times of two blocks can't be compared.
  bool beyond_noise() const;
};

// Nothing for fewer than two runs that have times.
std::optional<NodeDrift> drift_of(const std::vector<AnchorRun>& runs, std::optional<double> noise);

std::string drift_text(const NodeDrift& drift);

}  // namespace vsglbench
