// The measurements behind exhibits, each made once: a finished one of the same experiment, programme and
// device stands.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "figure/drawing.h"
#include "papers/exhibit.h"
#include "report/report.h"
#include "run/lights_run.h"

namespace vsglbench {

struct WorkOptions {
  std::string scale;             // of the configs; empty: as they are
  std::filesystem::path out;     // a folder a config below it
  std::filesystem::path assets;  // empty: $VSGLBENCH_ASSETS
  std::string device;            // as in select_device()
  bool force = false;            // measure anew
  bool as_is = false;            // take what is finished there, whatever programme made it
  std::vector<std::string> argv;
};

// A report or a set of files, and where it lies.
template <class Result>
struct Work {
  Result result;
  std::filesystem::path folder;
};

// For a process without threads and without a Vulkan device: it forks. Everything throws Error for what
// stops a config as a whole.
class PapersWork {
 public:
  explicit PapersWork(WorkOptions options) : options_(std::move(options)) {}

  // Interrupted ones are gone on with. The second time the first's.
  const Work<Report>& run(const std::string& config);
  // Pictures of `seed`, coverage of `kSeeds` from there.
  const Work<std::vector<LightsResult>>& lights(const std::string& config,
                                                const std::vector<std::string>& cases, uint32_t seed);
  // Width and height: 0 for the config's own.
  const Work<DrawnFigure>& figure(const std::string& config, uint32_t width, uint32_t height);
  const Json& code_sizes();  // device, sizes: what `code-size --json` prints

  static constexpr uint32_t kSeeds = 8;

 private:
  std::filesystem::path folder(const std::string& config, const std::string& of) const {
    return options_.out / folder_of(config, of);
  }
  WorkOptions options_;
  std::map<std::string, Work<Report>> runs_;
  std::map<std::string, Work<std::vector<LightsResult>>> lights_;
  std::map<std::string, Work<DrawnFigure>> figures_;
  std::optional<Json> code_sizes_;
};

}  // namespace vsglbench
