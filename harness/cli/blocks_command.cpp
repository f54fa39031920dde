#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/file.h"
#include "cli/command.h"
#include "measure/block_map.h"
#include "report/environment.h"

namespace vsglbench {
namespace {

struct BlocksOptions {
  std::vector<std::string> blocks;
  std::vector<uint64_t> sizes;
  int repetitions = 9;
  std::string device;
  std::filesystem::path out;
};

// Throws Error(output) where the report can't be written: better now than after the timing.
void check_writable(const std::filesystem::path& file) {
  std::error_code ec;
  if (std::filesystem::is_directory(file, ec)) {
    throw fail(ErrorKind::output, "--out {}: is a folder; give a file", file.string());
  }
  ensure_writable_directory(std::filesystem::absolute(file).parent_path());
}

// Without those that came before.
std::vector<uint64_t> distinct(const std::vector<uint64_t>& sizes) {
  std::vector<uint64_t> out;
  for (const uint64_t size : sizes) {
    if (std::ranges::count(out, size) == 0) out.push_back(size);
  }
  return out;
}

void measure(const BlocksOptions& options, const std::vector<std::string>& argv) {
  if (!options.out.empty()) check_writable(options.out);
  Device device({.select = options.device});
  const std::vector<uint64_t> sizes = distinct(options.sizes);
  Json maps = Json::array();
  for (const auto& name : options.blocks) {
    const auto block = make_block(device, name);
    const BlockMap map = measure_block(*block, sizes.empty() ? block->sizes() : sizes, options.repetitions);
    fmt::print("{}\n", block_table(map));
    std::fflush(stdout);
    maps.push_back(to_json(map));
  }
  const HostInfo host = host_info();
  const DeviceInfo& d = device.info();
  fmt::print("device: {} ({}, {} {}){}; host: {}, {} cores\n", d.name, d.type, d.driver, d.driver_version,
             device.is_cpu() ? ", the host's own cores" : "", host.cpu, host.cores);
  if (options.out.empty()) return;
  const Json report = {{"schema", "vsglbench.blocks/1"},
                       {"argv", argv},
                       {"git", {{"commit", build_git().commit}, {"dirty", build_git().dirty}}},
                       {"device",
                        {{"name", d.name},
                         {"type", d.type},
                         {"driver", d.driver},
                         {"driver_version", d.driver_version},
                         {"subgroup_size", d.subgroup_size}}},
                       {"host", {{"cpu", host.cpu}, {"cores", host.cores}}},
                       {"blocks", maps}};
  write_text(options.out, report.dump(2) + "\n");
}

}  // namespace

void add_blocks_command(CLI::App& app, const std::vector<std::string>& argv, CommandResult*) {
  for (const std::string name : {"blocks", "kernels"}) {
    auto options = std::make_shared<BlocksOptions>();
    CLI::App* command = app.add_subcommand(name, "time the methods' building blocks over their sizes");
    if (name == "kernels") command->group("");  // its name of version 0.1.0, for one release
    command->footer(
        "Each block is checked against the host's result before it is timed, and timed in turn with it. A "
        "size that\nthe device has no room for is reported as skipped.\n"
        "Example: vsglbench blocks sort --sizes 262144 2088960 --out blocks.json");
    command
        ->add_option("blocks", options->blocks,
                     "sort, nearest, sum, warp, mipmap; several or none: all of them")
        ->check(CLI::IsMember(block_names()));
    command->add_option("--sizes", options->sizes, "instead of each block's own")
        ->check(CLI::Range(uint64_t{1}, uint64_t{1} << 24));
    command->add_option("--repetitions", options->repetitions, "timed runs of each (default 9)")
        ->check(CLI::Range(1, 10000));
    command->add_option("--device", options->device,
                        "Vulkan device: index, UUID, PCI address or part of its name");
    command->add_option("--out", options->out, "file for the report as JSON");
    command->callback([=] {
      if (options->blocks.empty()) options->blocks = block_names();
      measure(*options, argv);
    });
  }
}

}  // namespace vsglbench
