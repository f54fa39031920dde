// A scene's cases in processes of their own, so that a case which crashes, hangs or loses the device costs
// itself and nothing else. This process touches neither Vulkan, nor the ray tracer, nor a method's code.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "run/scene_run.h"

namespace vsglbench {

struct WorkerOptions {
  DeviceOptions device;
  SceneOptions scenes;
  std::filesystem::path out;     // images go to out/images
  double time_limit_s = 600;     // of one action of a case
  std::function<void()> detach;  // called first in a worker: gives up what only the parent may hold
  Announce sabotage;             // tests only: called in the worker where a case's action begins
};

// The device as a process of its own finds it. Throws Error(device) when none can be used.
DeviceReport probe_device(const WorkerOptions& options);

// What the workers of a whole run have spent and met.
struct WorkerLog {
  WallTime wall;
  std::vector<std::string> validation_messages;
  std::string device_gone;  // why no device could be opened any more; empty: there is one
};

// Is given everything that a scene's workers find or lose, as soon as it is known; take_news()
// (run/scene_news.h) takes it back.
using Noted = std::function<void(const Json& news)>;

// Measures those of `cases` that `outcome` holds no result of, in one worker process. When that dies the case
// that was active fails (kind crashed, timeout or device_lost), what was found is kept, and a new worker goes
// on with the rest (base/supervise.h). One that dies at the harness's own work fails all that is left. When
// no device can be opened any more, all that are left fail with kind device.
void run_scene_in_workers(const std::string& scene, const Config& config, const std::vector<Case>& cases,
                          bool aa, const WorkerOptions& options, const Noted& noted, SceneOutcome* outcome,
                          WorkerLog* log);

}  // namespace vsglbench
