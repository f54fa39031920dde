#include "run/scene_clocks.h"

#include <algorithm>

namespace vsglbench {
namespace {

constexpr double kSecondsBetween = 1;

void add_once(const std::string& text, std::vector<std::string>* texts) {
  if (!text.empty() && std::ranges::find(*texts, text) == texts->end()) texts->push_back(text);
}

}  // namespace

void SceneClocks::look() {
  if (!watch_.missing().empty() || (since_ && since_->seconds() < kSecondsBetween)) return;
  since_.emplace();
  if (const auto reading = watch_.read()) add_reading(*reading, &report_);
}

void add_reading(const ClockReading& reading, std::optional<ClockReport>* report) {
  if (!*report) {
    report->emplace();
    (*report)->least_sm_mhz = reading.sm_mhz;
    (*report)->least_memory_mhz = reading.memory_mhz;
  }
  ClockReport& r = **report;
  ++r.readings;
  r.least_sm_mhz = std::min(r.least_sm_mhz, reading.sm_mhz);
  r.most_sm_mhz = std::max(r.most_sm_mhz, reading.sm_mhz);
  r.least_memory_mhz = std::min(r.least_memory_mhz, reading.memory_mhz);
  r.most_memory_mhz = std::max(r.most_memory_mhz, reading.memory_mhz);
  r.most_celsius = std::max(r.most_celsius, reading.celsius);
  r.most_watts = std::max(r.most_watts, reading.watts);
  add_once(reading.power_state, &r.power_states);
  for (const std::string& reason : reading.throttled_by) add_once(reason, &r.throttled_by);
}

}  // namespace vsglbench
