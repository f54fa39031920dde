// Whether a device's timestamps can be true. A driver or layer that returns nonsense must fail the frame: a
// report that holds 1.8e13 ms is believed.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace vsglbench {

struct TimestampClock {
  double ms_per_tick = 1e-6;
  uint32_t valid_bits = 64;                               // of a timestamp; the rest is masked off
  double milliseconds(uint64_t from, uint64_t to) const;  // wraps round as the bits do
};

// `stamps`: two a pass, in the order of the passes, all written by one submission that took the host
// `wall_ms` from before it was submitted until after it was waited for. What is wrong with the first of them
// that can't be true: one that was never written (0), one before its predecessor, or a span that is longer
// than the host saw; else empty.
std::string timestamp_fault(std::span<const uint64_t> stamps, const TimestampClock& clock, double wall_ms);

}  // namespace vsglbench
