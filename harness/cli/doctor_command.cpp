#include <fmt/format.h>

#include <vulkan/vulkan.h>

#include <cstring>

#include "base/error.h"
#include "base/file.h"
#include "cli/command.h"
#include "figure/gnuplot.h"
#include "gpu/device.h"
#include "image/font.h"
#include "method/registry.h"
#include "report/environment.h"

namespace vsglbench {
namespace {

bool has_layer(const char* name) {
  uint32_t count = 0;
  if (vkEnumerateInstanceLayerProperties(&count, nullptr) != VK_SUCCESS) return false;
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  for (const auto& layer : layers) {
    if (std::strcmp(layer.layerName, name) == 0) return true;
  }
  return false;
}

void print_host() {
  const HostInfo host = host_info();
  fmt::print("host        {}, {} cores, {:.1f} GiB, {}\n", host.cpu, host.cores,
             static_cast<double>(host.memory_bytes) / (1 << 30), host.os);
}

void print_device(const DeviceInfo& d) {
  fmt::print("device {}    {} ({})\n", d.index, d.name, d.type);
  fmt::print("  driver    {} {}, Vulkan {}\n", d.driver, d.driver_version, d.api);
  fmt::print("  subgroup  {} lanes; timestamps every {} ns, {} bits; storage buffers up to {} MiB\n",
             d.subgroup_size, d.timestamp_period_ns, d.timestamp_valid_bits, d.max_storage_range >> 20);
  for (const auto& missing : d.missing) fmt::print("  missing   {}\n", missing);
  if (d.missing.empty()) fmt::print("  usable\n");
}

// Whether one device has all that is needed.
bool examine_devices() {
  bool usable = false;
  try {
    const auto devices = list_devices();
    for (const auto& d : devices) {
      print_device(d);
      usable = usable || d.missing.empty();
    }
    if (devices.empty())
      fmt::print("device      none; install a driver (mesa-vulkan-drivers has lavapipe)\n");
  } catch (const Error& e) {
    fmt::print("device      none: {}\n", e.what());
  }
  fmt::print("validation  {}\n",
             has_layer("VK_LAYER_KHRONOS_validation")
                 ? "layer found"
                 : "layer missing (vulkan-validationlayers); --validate and its tests need it");
  return usable;
}

// Whether kernels, methods and descriptions are where the program looks for them.
bool examine_data() {
  fmt::print("data        {}\n", data_root().string());
  bool complete = true;
  for (const char* folder : {"harness/shaders", "harness/frame", "methods/_template",
                             "methods/_template_workgroup", "scenes", "configs"}) {
    std::error_code ec;
    if (std::filesystem::is_directory(data_root() / folder, ec)) continue;
    fmt::print("  missing   {}; set VSGLBENCH_ROOT to the source or installed folder\n", folder);
    complete = false;
  }
  return complete;
}

void examine_methods() {
  for (const auto& folder : plugin_folders()) {
    std::error_code ec;
    const bool present = std::filesystem::is_directory(folder, ec);
    fmt::print("plugins     {}{}\n", folder.string(), present ? "" : " (absent)");
  }
  for (const MethodInfo* method : all_methods()) {
    fmt::print("  {:<8}  {}\n", method->refused.empty() ? "method" : "refused",
               method->refused.empty() ? method->name : method->refused);
  }
}

// Both cost pictures only.
void examine_drawing() {
  try {
    const Font font(12);
    fmt::print("font        DejaVu Sans\n");
  } catch (const Error& e) {
    fmt::print("font        missing: {}; contact sheets, `lights` and `figure` need it\n", e.what());
  }
  try {
    fmt::print("gnuplot     {}\n", Gnuplot().version());
  } catch (const Error& e) {
    fmt::print("gnuplot     missing: {}; `figure` needs it\n", e.what());
  }
}

void examine_cache() {
  try {
    ensure_writable_directory(cache_directory());
    fmt::print("cache       {}\n", cache_directory().string());
  } catch (const Error& e) {  // costs time only
    fmt::print("cache       not writable, so nothing is kept: {}\n", e.what());
  }
}

void examine() {
  print_host();
  const bool usable = examine_devices();
  const bool complete = examine_data();
  examine_methods();
  examine_cache();
  examine_drawing();
  std::fflush(stdout);
  if (!usable) throw fail(ErrorKind::device, "no usable device; what each lacks is listed above");
  if (!complete) throw fail(ErrorKind::config, "the programme's data are incomplete, as listed above");
  fmt::print("ready\n");
}

}  // namespace

void add_doctor_command(CLI::App& app, CommandResult*) {
  CLI::App* command = app.add_subcommand("doctor", "say what this machine has and lacks");
  command->footer("Exit codes: 0 ready, 2 data missing, 3 no usable device.\nExample: vsglbench doctor");
  command->callback(examine);
}

}  // namespace vsglbench
