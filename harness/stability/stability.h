// The stability suite: hard cases × methods × diffuse models, each held to double precision.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "method/method.h"
#include "stability/cell.h"

namespace vsglbench {

struct StabilityOptions {
  std::vector<std::string> methods, cases, diffuse;  // names; empty: all
  std::string device;                                // as in DeviceOptions::select
  double silence_s = 120;                            // a case that takes longer is stopped, and bad
};

// A method with one choice of its parameters: "all-texels", "all-texels shading=vsgl16".
struct StabilityRow {
  std::string name;
  std::string method;
  Json parameters = Json::object();
};
// Each method, and again with each choice of each of its parameters that isn't the default. Throws
// Error(config) for an unknown method, Error(plugin) for a named one that is refused.
std::vector<StabilityRow> stability_rows(const std::vector<std::string>& methods);
std::vector<std::string> stability_cases();  // names, in order

// Tries each case with each method, in a process that is started anew where a method crashes or hangs, and
// tells each cell as it comes. The caller has neither threads nor a Vulkan device (base/supervise.h). Throws
// Error(usage) for an unknown case or diffuse model, Error(device) without a usable device, and as
// stability_rows().
std::vector<StabilityCell> run_stability(const StabilityOptions& options,
                                         const std::function<void(const StabilityCell&)>& on_cell);

}  // namespace vsglbench
