// vsglbench: what each method of making virtual lights costs, and what it is worth.
#include <cstdio>
#include <exception>
#include <new>

#include "base/error.h"
#include "base/log.h"
#include "cli/command.h"

namespace {

int report(const char* message, int code) {
  fmt::print(stderr, "vsglbench: {}\n", message);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace vsglbench;
  const std::vector<std::string> arguments(argv, argv + argc);
  CLI::App app("vsglbench: a benchmark of virtual-light methods for one-bounce indirect illumination");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 all cases ok, 1 a case failed, 2 bad usage, config or scene, 3 no usable device.\n"
      "Example: vsglbench run configs/quick.json");
  bool quiet = false, verbose = false;
  app.add_flag("-q,--quiet", quiet, "only warnings, errors and the table");
  app.add_flag("-v,--verbose", verbose, "say more");
  app.parse_complete_callback([&] {
    set_log_level(verbose ? LogLevel::verbose : quiet ? LogLevel::quiet : LogLevel::normal);
  });
  CommandResult result;
  add_run_command(app, arguments, &result);
  add_list_command(app, &result);
  add_reference_command(app, &result);
  add_doctor_command(app, &result);
  try {
    app.parse(argc, argv);
    return result.exit_code;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  } catch (const Error& e) {
    return report(e.what(), e.exit_code());
  } catch (const std::bad_alloc&) {
    return report("out of memory; use a smaller frame, RSM or number of lights", 1);
  } catch (const std::exception& e) {
    return report(e.what(), 1);
  }
}
