// The three speeds the project promises on a 2-core CPU device, each a ratio within one run. Target `bench`.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "frame/frame.h"
#include "measure/statistics.h"
#include "method/registry.h"
#include "reference/speed.h"
#include "run/config.h"
#include "run/runner.h"
#include "scene/scene_file.h"

using namespace vsglbench;

namespace {

// Evaluations of one SG lobe at one glossy pixel (its Lambert and its ASG lobe), per second of the shade
// pass.
double lobe_evaluations_per_second(const Scene& scene) {
  Device device;
  KernelLibrary kernels(device);
  Stage stage(device, kernels, scene);
  FrameParameters p;
  p.visibility = Visibility::none;
  p.importance_lights = 64;
  const MethodInfo& method = load_method(find_importance_maker(LightKind::vsgl).name, device.info());
  Frame frame(stage, method, resolve_parameters(method, Json::object()), p, nullptr);
  std::vector<double> seconds;
  for (int i = 0; i < 8; ++i) {
    for (const auto& [pass, ms] : frame.render(0).passes) {
      if (pass.stage == PassStage::shade && i > 0) seconds.push_back(ms * 1e-3);
    }
  }
  constexpr double lobes = 2;
  return lobes * p.width * p.height * p.lights / median(seconds);
}

double overhead_ratio() {
  const auto out = std::filesystem::temp_directory_path() / "vsglbench-bench";
  RunOptions options;
  options.config = config_path("quick");
  options.only = {"cornell/*"};
  options.out = out;
  options.argv = {"vsglbench-speed"};
  const double ratio = run_config(options).report.wall.overhead_ratio;
  std::filesystem::remove_all(out);
  return ratio;
}

bool print(const char* what, double value, const char* unit, double limit, bool at_least) {
  const bool met = at_least ? value >= limit : value <= limit;
  fmt::print("{:<58} {:>8.2f} {:<8} {} {:.2f}  {}\n", what, value, unit, at_least ? "at least" : "at most ",
             limit, met ? "met" : "MISSED");
  return met;
}

// The median of five runs; the bare loop makes one call a ray.
bool print_reference_speed(const std::string& name) {
  ReferenceParameters small;
  small.width = 240;
  small.height = 136;
  small.samples = 256;
  const Scene scene = load_scene(name, {data_root() / "scenes", {}});
  const SpeedRatio speed = measure_speed_ratio(scene, small, 5);
  return print(fmt::format("reference rays/s over a bare Embree loop's, {}", name).c_str(), speed.ratio(),
               "x", 0.7, true);
}

}  // namespace

// --check: exit 1 when a limit is missed.
int main(int argc, char** argv) {
  try {
    set_log_level(LogLevel::quiet);
    const Scene scene = load_scene("colonnade", {data_root() / "scenes", {}});
    bool met =
        print("shading, SG lobe evaluations", lobe_evaluations_per_second(scene) * 1e-6, "M/s", 120, true);
    for (const char* name : {"cornell", "ring514", "colonnade"}) met &= print_reference_speed(name);
    met &= print("wall over device time (references, rays, compiling aside)", overhead_ratio(), "x", 1.15,
                 false);
    return met || argc < 2 || std::string_view(argv[1]) != "--check" ? 0 : 1;
  } catch (const Error& e) {
    fmt::print(stderr, "vsglbench-speed: {}\n", e.what());
    return e.exit_code();
  }
}
