// The references of one scene of a sweep, computed into the cache before its cases are measured.
#pragma once

#include <filesystem>

#include "sweep/plan.h"

namespace vsglbench {

struct MadeReferences {
  std::string scene;
  size_t count = 0;        // in the cache now
  std::string impossible;  // why there are none, or not all: the cases will say the same
};

// Of scene `index` of SweepPlan::scenes(), of whole frames and of frames in motion alike. A scene that can't
// be loaded or is black is no Error here. Throws as check_unchanged(), and Error(usage) for an index too
// high.
MadeReferences make_references(const std::filesystem::path& sweep, size_t index);

}  // namespace vsglbench
