// A figure drawn in a process of its own: a method that crashes, hangs or loses the device costs its figure,
// and ends in an error like any other.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "figure/figure.h"

namespace vsglbench {

struct FigureOrder {
  Json config;                                   // checked
  std::filesystem::path assets;                  // where downloaded scenes lie
  std::filesystem::path folder;                  // for the files; exists
  std::string device;                            // as in select_device()
  double silence_s = 600;                        // that one step may take
  std::function<void(const DeviceInfo&)> admit;  // throws for what is too large for the device; may be empty
};

struct DrawnFigure {
  std::vector<std::filesystem::path> paths;  // of what was written
  std::vector<std::string> short_tables;     // CSV
  std::vector<Claim> claims;
  Json device;  // name, type, driver, driver_version
};

// As messages of the process that draws.
Json to_json(const DrawnFigure& drawn);
void from_json(const Json& json, DrawnFigure* drawn);

// For a process without threads and without a Vulkan device: it forks. Throws Error(device) where no device
// can be opened; else "figure NAME, method METHOD: ..." of the kind of what was wrong, Error(crashed) or
// Error(timeout) for a process that crashed or was stopped, Error(case_failed) for a device that was lost.
DrawnFigure draw_figure(const FigureOrder& order);

}  // namespace vsglbench
