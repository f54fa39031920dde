#include "gpu/clock_watch.h"

#include <dlfcn.h>

#include <fmt/format.h>

#include <cstring>
#include <utility>

// Names, values and signatures: NVIDIA, "NVML API Reference Guide", nvml.h.
namespace vsglbench {
namespace {

using Handle = void*;
constexpr int kSuccess = 0;
constexpr unsigned kClockSm = 1, kClockMemory = 2, kSensorGpu = 0;

struct Reason {
  uint64_t bit;
  const char* name;
};
constexpr Reason kReasons[] = {{0x4, "power cap"},       {0x8, "hardware slowdown"}, {0x10, "sync boost"},
                               {0x20, "hot (driver)"},   {0x40, "hot (hardware)"},   {0x80, "power brake"},
                               {0x100, "display clocks"}};

// "GPU-01234567-89ab-…" of 32 hex digits.
std::string nvml_uuid(const std::string& hex) {
  if (hex.size() != 32) return "";
  return fmt::format("GPU-{}-{}-{}-{}-{}", hex.substr(0, 8), hex.substr(8, 4), hex.substr(12, 4),
                     hex.substr(16, 4), hex.substr(20));
}

}  // namespace

struct ClockWatch::Library {
  template <class... Parameters>
  using Function = int (*)(Parameters...);

  void* handle = nullptr;
  Handle device = nullptr;
  bool started = false;
  Function<> init = nullptr, shutdown = nullptr;
  Function<const char*, Handle*> by_uuid = nullptr;
  Function<Handle, unsigned, unsigned*> clock = nullptr, temperature = nullptr;
  Function<Handle, int*> power_state = nullptr;
  Function<Handle, unsigned*> power = nullptr;
  Function<Handle, unsigned long long*> reasons = nullptr;

  template <class F>
  void find(const char* name, F* function) {
    if (!*function) *function = reinterpret_cast<F>(::dlsym(handle, name));
  }
  void find_all() {
    find("nvmlInit_v2", &init);
    find("nvmlShutdown", &shutdown);
    find("nvmlDeviceGetHandleByUUID", &by_uuid);
    find("nvmlDeviceGetClockInfo", &clock);
    find("nvmlDeviceGetTemperature", &temperature);
    find("nvmlDeviceGetPerformanceState", &power_state);
    find("nvmlDeviceGetPowerUsage", &power);
    find("nvmlDeviceGetCurrentClocksEventReasons", &reasons);     // since driver 535
    find("nvmlDeviceGetCurrentClocksThrottleReasons", &reasons);  // before
  }
  ~Library() {
    if (started && shutdown) shutdown();
    if (handle) ::dlclose(handle);
  }
};

ClockWatch::ClockWatch(const std::string& uuid, const std::string& library)
    : library_(std::make_unique<Library>()) {
  Library& nvml = *library_;
  nvml.handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!nvml.handle) {
    missing_ = library + " is not there";
    return;
  }
  nvml.find_all();
  nvml.started = nvml.init && nvml.init() == kSuccess;
  if (!nvml.started) {
    missing_ = library + " does not start";
    return;
  }
  const std::string name = nvml_uuid(uuid);
  if (name.empty() || !nvml.by_uuid || nvml.by_uuid(name.c_str(), &nvml.device) != kSuccess)
    missing_ = library + " does not know the device";
}

std::optional<std::string> nvml_uuid_of(unsigned index, const std::string& library) {
  void* const handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) return std::nullopt;
  const auto init = reinterpret_cast<int (*)()>(::dlsym(handle, "nvmlInit_v2"));
  const auto shutdown = reinterpret_cast<int (*)()>(::dlsym(handle, "nvmlShutdown"));
  const auto by_index =
      reinterpret_cast<int (*)(unsigned, Handle*)>(::dlsym(handle, "nvmlDeviceGetHandleByIndex_v2"));
  const auto uuid_of =
      reinterpret_cast<int (*)(Handle, char*, unsigned)>(::dlsym(handle, "nvmlDeviceGetUUID"));
  char text[96] = {};
  Handle device = nullptr;
  const bool started = init && init() == kSuccess;
  const bool told = started && by_index && uuid_of && by_index(index, &device) == kSuccess &&
                    uuid_of(device, text, sizeof text - 1) == kSuccess;
  if (started && shutdown) shutdown();
  ::dlclose(handle);
  if (!told) return std::nullopt;
  std::string hex;  // without "GPU-" and dashes
  for (const char* c = std::strchr(text, '-'); c && *c; ++c)
    if (*c != '-') hex += *c;
  return hex;
}

ClockWatch::~ClockWatch() = default;

std::optional<ClockReading> ClockWatch::read() const {
  if (!missing_.empty()) return std::nullopt;
  const Library& nvml = *library_;
  ClockReading reading;
  bool any = false;
  unsigned value = 0;
  const auto ask = [&](auto function, auto... arguments) {
    const bool answered = function && function(nvml.device, arguments...) == kSuccess;
    any |= answered;
    return answered;
  };
  if (ask(nvml.clock, kClockSm, &value)) reading.sm_mhz = value;
  if (ask(nvml.clock, kClockMemory, &value)) reading.memory_mhz = value;
  if (ask(nvml.temperature, kSensorGpu, &value)) reading.celsius = value;
  if (ask(nvml.power, &value)) reading.watts = 1e-3 * value;  // mW
  int state = 0;
  if (ask(nvml.power_state, &state) && state >= 0 && state < 16)
    reading.power_state = fmt::format("P{}", state);
  unsigned long long bits = 0;
  if (ask(nvml.reasons, &bits)) reading.throttled_by = throttle_reasons(bits);
  if (!any) return std::nullopt;
  return reading;
}

std::vector<std::string> throttle_reasons(uint64_t bits) {
  std::vector<std::string> names;
  for (const Reason& reason : kReasons)
    if (bits & reason.bit) names.emplace_back(reason.name);
  return names;
}

}  // namespace vsglbench
