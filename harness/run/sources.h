// What a report's numbers were made by, beside the programme itself.
#pragma once

#include <string>

#include "run/config.h"

namespace vsglbench {

// The hash of everything that is compiled at run time, and of the plugins of the config's methods: a report's
// `kernels`.
std::string sources_hash(const Config& config);

}  // namespace vsglbench
