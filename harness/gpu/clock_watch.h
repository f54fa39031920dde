// What the clocks of an NVIDIA GPU do, as its management library (NVML) tells. The library is loaded when the
// programme runs, where it is there; nothing depends on it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vsglbench {

struct ClockReading {
  uint32_t sm_mhz = 0, memory_mhz = 0, celsius = 0;
  double watts = 0;
  std::string power_state;                // "P0", the fastest, to "P15"; empty: unknown
  std::vector<std::string> throttled_by;  // what holds a clock down: "power cap", "hot", …
};

class ClockWatch {
 public:
  // `uuid`: of the device, as DeviceInfo has it. Without the library, or a device that it knows by this UUID,
  // there are no readings.
  explicit ClockWatch(const std::string& uuid, const std::string& library = "libnvidia-ml.so.1");
  ~ClockWatch();
  ClockWatch(const ClockWatch&) = delete;
  ClockWatch& operator=(const ClockWatch&) = delete;

  // What a query does not answer stays 0 or empty; nothing where none answers.
  std::optional<ClockReading> read() const;
  // Why there are no readings; empty: there are.
  const std::string& missing() const { return missing_; }

 private:
  struct Library;
  std::unique_ptr<Library> library_;
  std::string missing_;
};

// The UUID, as DeviceInfo has it, of the GPU that NVML counts so: in the order of the bus, as
// CUDA_VISIBLE_DEVICES of an engine such as Slurm does. Nothing without the library, or for a number that it
// has no GPU of.
std::optional<std::string> nvml_uuid_of(unsigned index, const std::string& library = "libnvidia-ml.so.1");

// The names of the bits of NVML's "clocks throttle reasons", but for an idle GPU and for clocks that somebody
// has set.
std::vector<std::string> throttle_reasons(uint64_t bits);

}  // namespace vsglbench
