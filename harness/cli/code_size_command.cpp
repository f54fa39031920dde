#include <fmt/format.h>

#include "cli/command.h"
#include "method/registry.h"
#include "run/code_size.h"

namespace vsglbench {

void add_code_size_command(CLI::App& app, CommandResult*) {
  auto json = std::make_shared<bool>(false);
  auto device = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("code-size", "kernels, dispatches and lines of each method ([MFIS16] Tab. 3)");
  command->footer("Example: vsglbench code-size");
  command->add_flag("--json", *json, "as JSON, with the files that were counted");
  command->add_option("--device", *device, "Vulkan device: index, UUID, PCI address or part of its name");
  command->callback([=] {
    Device opened({.select = *device});
    std::vector<CodeSize> sizes;
    for (const MethodInfo* method : all_methods()) {
      if (method->refused.empty()) sizes.push_back(code_size(opened, method->name));
    }
    Json rows = Json::array();
    for (const auto& size : sizes) rows.push_back(to_json(size));
    fmt::print("{}", *json ? rows.dump(2) + "\n" : code_size_table(sizes));
  });
}

}  // namespace vsglbench
