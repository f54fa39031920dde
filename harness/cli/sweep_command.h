// `vsglbench sweep`, in cli/sweep_command.cpp.
#pragma once

#include "cli/command.h"

namespace vsglbench {

void add_sweep_command(CLI::App& app, CommandResult* result);

}  // namespace vsglbench
