// vsglbench: what each method of making virtual lights costs, and what it is worth.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <system_error>

#include "base/error_list.h"
#include "base/json.h"
#include "base/log.h"
#include "base/nearest.h"
#include "base/printable.h"
#include "cli/command.h"
#include "cli/scene_commands.h"
#include "cli/sweep_command.h"
#include "image/theme.h"
#include "method/plugin.h"
#include "method/registry.h"
#include "report/environment.h"

namespace {

using namespace vsglbench;

int report(const std::string& message, int code) {
  std::fputs(("vsglbench: " + excerpt(message, kLongestMessage) + "\n").c_str(),
             stderr);  // never throws, unlike fmt::print
  return code;
}

// What is wrong with the command line, on one line; a misspelt command is met with the nearest.
int report_usage(const CLI::App& app, const CLI::ParseError& e, const std::vector<std::string>& arguments) {
  std::vector<std::string> known, shown;  // those without a group are not for users
  for (const CLI::App* command : app.get_subcommands({})) {
    known.push_back(command->get_name());
    if (!command->get_group().empty()) shown.push_back(command->get_name());
  }
  const std::string first = arguments.size() > 1 ? arguments[1] : "";
  const bool is_command = std::find(known.begin(), known.end(), first) != known.end();
  if (!first.empty() && first.front() != '-' && !is_command) {
    return report(fmt::format("no command '{}'{}", first, suggestion(first, shown)),
                  exit_code(ErrorKind::usage));
  }
  const std::string help = is_command ? "vsglbench " + first + " --help" : "vsglbench --help";
  std::string what = e.what();
  if (what.ends_with('.')) what.pop_back();
  return report(fmt::format("{}; see {}", what, help), exit_code(ErrorKind::usage));
}

// NaN passes every check of a range.
void refuse_no_numbers(CLI::App* command) {
  for (CLI::Option* option : command->get_options()) {
    if (!option->get_type_name().starts_with("FLOAT")) continue;
    const auto refuse = [](std::string& text) {
      return std::isfinite(std::strtod(text.c_str(), nullptr)) ? "" : text + " is no finite number";
    };
    option->check(CLI::Validator(refuse, "", ""));
  }
}

bool is_utf8(const std::string& text) {
  try {
    static_cast<void>(Json(text).dump());
    return true;
  } catch (const Json::type_error&) {
    return false;
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ,
              SIG_IGN);  // a write over a size limit then fails with an error, and is reported as one
  const std::vector<std::string> arguments(argv, argv + argc);
  // Reports hold the command line, and JSON is UTF-8: better now than after the measurement.
  for (size_t i = 1; i < arguments.size(); ++i) {
    if (!is_utf8(arguments[i]))
      return report(fmt::format("argument {} is not UTF-8: {}; give files names that are", i, arguments[i]),
                    2);
  }
  CLI::App app("vsglbench: a benchmark of virtual-light methods for one-bounce indirect illumination");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 all cases ok, 1 a case failed, 2 bad usage, config, scene, plugin or output, 3 no "
      "usable "
      "device,\n4 'compare' found a regression, 5 'compare' refuses, or a pass may be slower and can't be "
      "told;\n'sweep': 5 shards or cases are missing, or refused, 6 a task stands on the wrong device.\n"
      "Example: vsglbench run configs/quick.json");
  bool quiet = false, verbose = false;
  app.add_flag("-q,--quiet", quiet, "only warnings, errors and the table");
  app.add_flag("-v,--verbose", verbose, "say more");
  std::string plugin_path;
  app.add_option("--plugin-path", plugin_path,
                 "folders of method plugins, separated by ':', searched before $VSGLBENCH_PLUGINS");
  std::string theme = theme_names().front();
  app.add_option("--theme", theme, "of contact sheets, error maps and pictures of lights; light is for print")
      ->check(CLI::IsMember(theme_names()))
      ->capture_default_str();
  app.set_version_flag("--version", fmt::format("vsglbench {} (commit {}, plugin ABI {})", VSGLBENCH_VERSION,
                                                build_git().commit, plugin_abi));
  app.parse_complete_callback([&] {
    set_log_level(verbose ? LogLevel::verbose : quiet ? LogLevel::quiet : LogLevel::normal);
    set_plugin_path(plugin_path);
    set_theme(theme);
  });
  CommandResult result;
  add_run_command(app, arguments, &result);
  add_reproduce_command(app, arguments, &result);
  add_sweep_command(app, &result);
  add_list_command(app, &result);
  add_reference_command(app, &result);
  add_new_scene_command(app);
  add_view_command(app);
  add_effects_command(app);
  add_doctor_command(app, &result);
  add_check_method_command(app, &result);
  add_new_method_command(app, &result);
  add_code_size_command(app, &result);
  add_blocks_command(app, arguments, &result);
  add_lights_command(app, arguments, &result);
  add_metrics_command(app, &result);
  add_sg_command(app, &result);
  add_figure_command(app, arguments, &result);
  add_stability_command(app, &result);
  add_table_command(app);
  add_answer_command(app);
  add_analyse_command(app);
  add_plot_command(app);
  add_claims_command(app);
  add_dashboard_command(app);
  add_compare_command(app, &result);
  add_export_command(app);
  add_export_frames_command(app);
  for (CLI::App* command : app.get_subcommands({})) {
    command->fallthrough();  // -q and the like may come last
    refuse_no_numbers(command);
  }
  try {
    app.parse(argc, argv);
    if (std::fflush(stdout) != 0) throw fail(ErrorKind::output, "standard output: {}", std::strerror(errno));
    if (std::ferror(stdout)) {
      throw Error(ErrorKind::output,
                  "standard output: what was printed could not be written; is the disk full?");
    }
    return result.exit_code;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0) return report_usage(app, e, arguments);
    const int code = app.exit(e);  // prints help or version
    if (std::cout.flush()) return code;
    return report(fmt::format("standard output: {}", std::strerror(errno)), exit_code(ErrorKind::output));
  } catch (const ErrorList& e) {
    for (const std::string& line : e.lines()) report(line, e.exit_code());
    return e.exit_code();
  } catch (const Error& e) {
    return report(e.what(), e.exit_code());
  } catch (const std::bad_alloc&) {
    return report("out of memory; use a smaller frame, RSM or number of lights",
                  exit_code(ErrorKind::case_failed));
  } catch (const std::system_error& e) {
    // fmt::print's, where what is printed is more than a buffer; files have errors of their own.
    if (!std::ferror(stdout)) return report(e.what(), exit_code(ErrorKind::internal));
    return report(fmt::format("standard output: {}", e.code().message()), exit_code(ErrorKind::output));
  } catch (const std::exception& e) {
    return report(e.what(), exit_code(ErrorKind::internal));
  }
}
