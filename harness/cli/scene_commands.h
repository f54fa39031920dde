// The subcommands that make, show and take apart a scene, beside those of command.h.
#pragma once

#include "cli/command.h"

namespace vsglbench {

void add_new_scene_command(CLI::App& app);
void add_view_command(CLI::App& app);

}  // namespace vsglbench
