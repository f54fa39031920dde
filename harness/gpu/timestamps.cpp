#include "gpu/timestamps.h"

#include <fmt/format.h>

namespace vsglbench {
namespace {

// The device's clock and the host's may run apart by so much, and each is read a little beside the work.
constexpr double kClockSlack = 0.02, kSlackMs = 1;

uint64_t mask_of(uint32_t bits) { return bits >= 64 ? ~uint64_t{0} : (uint64_t{1} << bits) - 1; }

}  // namespace

double TimestampClock::milliseconds(uint64_t from, uint64_t to) const {
  return static_cast<double>((to - from) & mask_of(valid_bits)) * ms_per_tick;
}

std::string timestamp_fault(std::span<const uint64_t> stamps, const TimestampClock& clock, double wall_ms) {
  const double most = wall_ms * (1 + kClockSlack) + kSlackMs;
  for (size_t i = 0; i < stamps.size(); ++i) {
    if (stamps[i] == 0)
      return fmt::format("timestamp {} of {} is 0: it was never written", i + 1, stamps.size());
    if (i == 0) continue;
    // A step back looks like nearly the whole range of the clock, which no frame lasts.
    const double ms = clock.milliseconds(stamps[i - 1], stamps[i]);
    if (ms > most) {
      return fmt::format(
          "timestamp {} of {} lies {:.4g} ms after the one before it, or before it; the host waited {:.4g} "
          "ms",
          i + 1, stamps.size(), ms, wall_ms);
    }
  }
  if (stamps.empty()) return "";
  const double span = clock.milliseconds(stamps.front(), stamps.back());
  if (span > most) return fmt::format("the passes span {:.4g} ms; the host waited {:.4g} ms", span, wall_ms);
  return "";
}

}  // namespace vsglbench
