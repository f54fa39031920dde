// The device's clocks over the timed frames of a scene.
#pragma once

#include <optional>
#include <string>

#include "gpu/clock_watch.h"
#include "measure/stopwatch.h"
#include "report/report.h"

namespace vsglbench {

class SceneClocks {
 public:
  // `earlier`: what another process has seen of the same scene.
  SceneClocks(const std::string& device_uuid, std::optional<ClockReport> earlier)
      : watch_(device_uuid), report_(std::move(earlier)) {}
  // Between two rounds of frames: the library is asked once a second at most, since it takes its time.
  void look();
  const std::optional<ClockReport>& report() const { return report_; }

 private:
  ClockWatch watch_;
  std::optional<Stopwatch> since_;
  std::optional<ClockReport> report_;
};

void add_reading(const ClockReading& reading, std::optional<ClockReport>* report);

}  // namespace vsglbench
