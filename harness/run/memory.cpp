#include "run/memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "base/error.h"
#include "method/registry.h"
#include "reference/footprint.h"

namespace vsglbench {
namespace {

constexpr uint64_t kUnknown = std::numeric_limits<uint64_t>::max();

// The number after `key` in a file of lines "key number", or the file's one number where `key` is empty.
uint64_t number_in(const char* path, const std::string& key) {
  std::ifstream in(path);
  std::string word;
  uint64_t value = 0;
  if (key.empty()) return in >> value ? value : kUnknown;
  while (in >> word) {
    if (word == key) return in >> value ? value : kUnknown;
  }
  return kUnknown;
}

uint64_t pixels_of(uint32_t width, uint32_t height) { return uint64_t(width) * height; }

// What the limit on data (ulimit -d) or address space (ulimit -v) leaves.
uint64_t within_limit(int resource, const char* used_key) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnknown;
  const uint64_t used_kib = number_in("/proc/self/status", used_key);
  return used_kib == kUnknown ? kUnknown
                              : limit.rlim_cur - std::min<uint64_t>(limit.rlim_cur, used_kib * 1024);
}

// What the control group leaves; cached files give way.
uint64_t within_control_group() {
  const uint64_t limit = number_in("/sys/fs/cgroup/memory.max", "");
  const uint64_t used = number_in("/sys/fs/cgroup/memory.current", "");
  const uint64_t cached = number_in("/sys/fs/cgroup/memory.stat", "inactive_file");
  if (limit == kUnknown || used == kUnknown) return kUnknown;
  const uint64_t taken = used - std::min(used, cached == kUnknown ? 0 : cached);
  return limit - std::min(limit, taken);
}

double gib(uint64_t bytes) { return static_cast<double>(bytes) / (1 << 30); }

void require(uint64_t need, const std::string& what) {
  const uint64_t free = available_memory();
  if (need <= free / 10 * 9) return;
  throw fail(ErrorKind::case_failed,
             "{} needs about {:.1f} GiB of memory and {:.1f} are free; make it smaller", what, gib(need),
             gib(free));
}

}  // namespace

uint64_t available_memory() {
  const uint64_t kib = number_in("/proc/meminfo", "MemAvailable:");
  const uint64_t system = kib == kUnknown ? kUnknown : kib * 1024;
  return std::min({system, within_control_group(), within_limit(RLIMIT_DATA, "VmData:"),
                   within_limit(RLIMIT_AS, "VmSize:")});
}

MemoryNeed reference_memory(uint32_t width, uint32_t height) {
  constexpr uint64_t kSums = 9 * sizeof(double), kImages = 5 * sizeof(glm::vec3);
  constexpr uint64_t kPool = 128 << 20;  // at most
  return {pixels_of(width, height) * (sizeof(Footprint) + kSums + kImages) + kPool, 0};
}

uint64_t kept_memory(const Case& c) {
  if (c.frame.visibility != Visibility::exact) return 0;
  const MethodInfo& method = find_method(c.method);
  const uint64_t own = method.light_count > 0 ? method.light_count : pixels_of(c.frame.rsm, c.frame.rsm);
  const uint64_t lights = method.takes_light_count ? c.frame.lights : own;
  return lights * ((pixels_of(c.frame.width, c.frame.height) + 31) / 32) * sizeof(uint32_t);
}

MemoryNeed frame_memory(const Case& c) {
  constexpr uint64_t kVec4 = 16, kTargets = 5 * kVec4 + 4, kMoments = 5 * kVec4 * 4 / 3, kPdf = 6;
  const uint64_t pixels = pixels_of(c.frame.width, c.frame.height),
                 texels = pixels_of(c.frame.rsm, c.frame.rsm);
  const uint64_t bits = kept_memory(c);
  constexpr uint64_t kImages = 4 * sizeof(glm::vec3) + 3 * kVec4;  // of the case, and downloads
  return {pixels * kImages + bits, (pixels + texels) * (kTargets + kMoments + kPdf) + pixels * kVec4 + bits};
}

void require_memory(const DeviceInfo& device, const Case& c, uint64_t taken) {
  const MemoryNeed need = frame_memory(c);
  const std::string what = fmt::format("a frame of {} x {} with an RSM of {} x {}", c.frame.width,
                                       c.frame.height, c.frame.rsm, c.frame.rsm);
  const bool cpu = device.type == "cpu";
  require(need.host + taken + (cpu ? need.device : 0), what);
  if (!cpu && need.device > device.memory_bytes) {
    throw fail(ErrorKind::case_failed,
               "{} needs about {:.1f} GiB of the device's memory of {:.1f}; make it smaller", what,
               gib(need.device), gib(device.memory_bytes));
  }
}

void require_reference_memory(uint32_t width, uint32_t height) {
  require(reference_memory(width, height).host, fmt::format("a reference of {} x {}", width, height));
}

}  // namespace vsglbench
