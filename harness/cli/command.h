// One file a subcommand; each adds itself to the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace vsglbench {

// Set by the subcommand that ran.
struct CommandResult {
  int exit_code = 0;
};

void add_reproduce_command(CLI::App& app, const std::vector<std::string>& argv, CommandResult* result);
void add_run_command(CLI::App& app, const std::vector<std::string>& argv, CommandResult* result);
void add_list_command(CLI::App& app, CommandResult* result);
void add_reference_command(CLI::App& app, CommandResult* result);
void add_effects_command(CLI::App& app);
void add_doctor_command(CLI::App& app, CommandResult* result);
void add_check_method_command(CLI::App& app, CommandResult* result);
void add_new_method_command(CLI::App& app, CommandResult* result);
void add_code_size_command(CLI::App& app, CommandResult* result);
void add_blocks_command(CLI::App& app, const std::vector<std::string>& argv, CommandResult* result);
void add_figure_command(CLI::App& app, const std::vector<std::string>& argv, CommandResult* result);
void add_lights_command(CLI::App& app, const std::vector<std::string>& argv, CommandResult* result);
void add_metrics_command(CLI::App& app, CommandResult* result);
void add_sg_command(CLI::App& app, CommandResult* result);
void add_stability_command(CLI::App& app, CommandResult* result);
void add_table_command(CLI::App& app);
void add_answer_command(CLI::App& app);
void add_analyse_command(CLI::App& app);
void add_plot_command(CLI::App& app);
void add_claims_command(CLI::App& app);
void add_dashboard_command(CLI::App& app);
void add_compare_command(CLI::App& app, CommandResult* result);
void add_export_command(CLI::App& app);
void add_export_frames_command(CLI::App& app);

}  // namespace vsglbench
