#include <fmt/format.h>

#include <vulkan/vulkan.h>

#include <cstring>

#include "base/error.h"
#include "base/file.h"
#include "cli/command.h"
#include "gpu/device.h"
#include "report/environment.h"

namespace vsglbench {
namespace {

bool has_layer(const char* name) {
  uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  for (const auto& layer : layers) {
    if (std::strcmp(layer.layerName, name) == 0) return true;
  }
  return false;
}

// Prints every finding; returns whether the machine can run the benchmark.
bool examine() {
  const HostInfo host = host_info();
  fmt::print("host        {}, {} cores, {:.1f} GiB, {}\n", host.cpu, host.cores,
             static_cast<double>(host.memory_bytes) / (1 << 30), host.os);
  bool usable = false;
  for (const auto& d : list_devices()) {
    fmt::print("device {}    {} ({})\n", d.index, d.name, d.type);
    fmt::print("  driver    {} {}, Vulkan {}\n", d.driver, d.driver_version, d.api);
    fmt::print("  subgroup  {} lanes; timestamps every {} ns, {} bits; storage buffers up to {} MiB\n", d.subgroup_size,
               d.timestamp_period_ns, d.timestamp_valid_bits, d.max_storage_range >> 20);
    for (const auto& missing : d.missing) fmt::print("  missing   {}\n", missing);
    if (d.missing.empty()) fmt::print("  usable\n");
    usable = usable || d.missing.empty();
  }
  fmt::print("validation  {}\n", has_layer("VK_LAYER_KHRONOS_validation")
                                     ? "layer found"
                                     : "layer missing (vulkan-validationlayers); --validate and its tests need it");
  fmt::print("data        {}\n", data_root().string());
  for (const char* folder : {"harness/shaders", "methods", "scenes", "configs"}) {
    if (!std::filesystem::is_directory(data_root() / folder)) {
      fmt::print("  missing   {}; set VSGLBENCH_ROOT to the source or installed folder\n", folder);
      usable = false;
    }
  }
  fmt::print("cache       {}\n", cache_directory().string());
  return usable;
}

}  // namespace

void add_doctor_command(CLI::App& app, CommandResult*) {
  CLI::App* command = app.add_subcommand("doctor", "say what this machine has and lacks");
  command->footer("Example: vsglbench doctor");
  command->callback([] {
    if (!examine()) throw fail(ErrorKind::device, "no usable device; what each lacks is listed above");
    fmt::print("ready\n");
  });
}

}  // namespace vsglbench
