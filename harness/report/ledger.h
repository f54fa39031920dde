// The ledger of a scene's effects as text.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace vsglbench {

// Every effect on a line: needed or skipped, what it adds to a frame where that is priced, and why.
std::string ledger_text(const std::vector<EffectReport>& effects);

// In a line how many effects the scene calls for, and which. Where they are priced, below it what all would
// cost, and what each adds to a frame.
std::string short_ledger(const SceneReport& scene);

// The ledgers of all scenes that have one, in full. Throws Error(usage) where none has.
std::string ledgers_of(const Report& report);

}  // namespace vsglbench
