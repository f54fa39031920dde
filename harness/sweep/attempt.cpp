#include "sweep/attempt.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>

#include "base/error.h"
#include "base/file.h"
#include "base/progress.h"
#include "report/report.h"
#include "sweep/shard_folder.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

std::string host_name() {
  char name[256] = {};
  ::gethostname(name, sizeof name - 1);
  return name;
}

std::string first_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

// When the process began, in ticks since the machine's start; 0: there is no such process, or it is dead and
// waits for its parent.
int64_t started_ticks(int64_t pid) {
  const std::string line = first_line(fmt::format("/proc/{}/stat", pid));
  const size_t end_of_name = line.rfind(')');
  if (end_of_name == std::string::npos) return 0;
  std::istringstream rest(line.substr(end_of_name + 1));
  std::string field;
  for (int i = 3; i <= 22 && rest >> field; ++i) {
    if (i == 3 && (field == "Z" || field == "X")) return 0;
    if (i == 22) return std::strtoll(field.c_str(), nullptr, 10);
  }
  return 0;
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

// Slurm's; GNU parallel numbers its own.
std::string job_of_engine() {
  const std::string array = environment("SLURM_ARRAY_JOB_ID");
  if (!array.empty()) return array + "_" + environment("SLURM_ARRAY_TASK_ID");
  return environment("SLURM_JOB_ID");
}

Json to_json(const AttemptOwner& o) {
  return {{"host", o.host},      {"node", o.node}, {"job", o.job},
          {"space", o.space},    {"pid", o.pid},   {"started_ticks", o.started_ticks},
          {"started", o.started}};
}

AttemptOwner owner_from_json(const Json& json) {
  return {json.at("host"), json.at("node"),          json.at("job"),    json.at("space"),
          json.at("pid"),  json.at("started_ticks"), json.at("started")};
}

// Nothing where there is no such file, or it is none of ours.
std::optional<Json> read_json(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  Json json = Json::parse(file, nullptr, false);
  return json.is_discarded() ? std::nullopt : std::optional(std::move(json));
}

double modified(const fs::path& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0) return 0;
  return static_cast<double>(about.st_mtim.tv_sec) + 1e-9 * static_cast<double>(about.st_mtim.tv_nsec);
}

std::optional<AttemptEnd> end_in(const fs::path& path) {
  const auto json = read_json(path);
  if (!json) return std::nullopt;
  try {
    return AttemptEnd{json->at("ended"), json->at("exit_code"), json->at("done"), json->at("message")};
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

Attempt attempt_in(const fs::path& lock, size_t number, double now, double silent_s) {
  Attempt a{.number = number};
  try {
    if (const auto json = read_json(lock)) a.owner = owner_from_json(*json);
  } catch (const Json::exception&) {  // of an owner that can't be told; its touches can
  }
  a.end = end_in(fs::path(lock).replace_extension(".end"));
  a.silent_s = std::max(0.0, now - modified(lock));
  if (a.end) return a;
  const AttemptOwner self = this_process();
  if (!a.owner.space.empty() && a.owner.space == self.space) {
    a.alive = started_ticks(a.owner.pid) == a.owner.started_ticks;
  } else {
    a.alive = a.silent_s < silent_s;
    a.certain = false;
  }
  return a;
}

// "attempt-12.lock" as 12; 0 for any other name.
size_t number_of(const std::string& name) {
  constexpr std::string_view kBegin = "attempt-", kEnd = ".lock";
  if (!name.starts_with(kBegin) || !name.ends_with(kEnd)) return 0;
  size_t number = 0;
  const auto parsed = std::from_chars(name.data() + kBegin.size(), name.data() + name.size(), number);
  return name.substr(static_cast<size_t>(parsed.ptr - name.data())) == kEnd ? number : 0;
}

// Whether `lock` is now a name of the file `ours`, and was none of another.
bool linked(const fs::path& ours, const fs::path& lock) {
  if (::link(ours.c_str(), lock.c_str()) == 0) return true;
  if (errno != EEXIST)
    throw fail(ErrorKind::output, "{}: can't be made: {}", lock.string(), std::strerror(errno));
  struct stat about {};
  return ::stat(ours.c_str(), &about) == 0 && about.st_nlink == 2;  // the server's answer was lost
}

}  // namespace

AttemptOwner this_process() {
  std::error_code ec;
  AttemptOwner self;
  self.host = host_name();
  self.node = environment("SLURMD_NODENAME");
  self.job = job_of_engine();
  self.space = first_line("/proc/sys/kernel/random/boot_id") + " " +
               fs::read_symlink("/proc/self/ns/pid", ec).string();
  self.pid = ::getpid();
  self.started_ticks = started_ticks(self.pid);
  self.started = utc_now();
  return self;
}

std::string Attempt::told() const {
  const std::string where = owner.node.empty() ? owner.host : owner.node;
  std::string text = fmt::format("attempt {} on {}", number, where.empty() ? "an unknown machine" : where);
  if (end && end->done) return text + ": done";
  if (end) return text + ": " + end->message;
  if (alive) return text + ", since " + owner.started;
  if (certain) return text + ": its process is gone, and wrote no end";
  return text + ": no sign of life for " + format_duration(silent_s);
}

double server_time(const fs::path& folder) {
  static std::atomic<unsigned> serial{0};
  const fs::path probe = folder / fmt::format(".now.{}.{}.{}", host_name(), ::getpid(), serial++);
  std::error_code ec;
  double now = 0;
  if (std::ofstream(probe) << '\n') now = modified(probe);
  fs::remove(probe, ec);
  if (now > 0) return now;
  timespec local{};  // the folder can't be written to: whoever only looks goes by its own clock
  ::clock_gettime(CLOCK_REALTIME, &local);
  return static_cast<double>(local.tv_sec) + 1e-9 * static_cast<double>(local.tv_nsec);
}

std::vector<Attempt> attempts_in(const fs::path& folder, double silent_s) {
  std::vector<std::pair<size_t, fs::path>> locks;
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(folder, ec))
    if (const size_t number = number_of(entry.path().filename().string()))
      locks.emplace_back(number, entry.path());
  std::ranges::sort(locks);
  const double now = locks.empty() ? 0 : server_time(folder);
  std::vector<Attempt> attempts;
  for (const auto& [number, lock] : locks) attempts.push_back(attempt_in(lock, number, now, silent_s));
  return attempts;
}

fs::path AttemptLock::file(const char* extension) const {
  return folder_ / fmt::format("attempt-{}{}", number_, extension);
}

std::optional<AttemptLock> AttemptLock::take(const fs::path& folder, Attempt* holder, double silent_s) {
  ensure_writable_directory(folder);
  const AttemptOwner self = this_process();
  std::random_device random;
  const fs::path ours = folder / fmt::format(".lock.{}.{}.{:08x}", self.host, self.pid, random());
  write_text(ours, to_json(self).dump() + "\n");
  sync_path(ours);
  std::optional<AttemptLock> taken;
  while (!taken) {
    const std::vector<Attempt> before = attempts_in(folder, silent_s);
    if (!before.empty() && before.back().alive) {
      *holder = before.back();
      break;
    }
    AttemptLock next(folder, before.empty() ? 1 : before.back().number + 1);
    if (linked(ours, next.file(".lock"))) {
      taken = next;
    } else {  // another has; its lock may take a moment to be seen here
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
  std::error_code ec;
  fs::remove(ours, ec);
  if (taken) taken->beat();
  return taken;
}

void AttemptLock::beat() const noexcept {
  ::utimensat(AT_FDCWD, file(".lock").c_str(), nullptr, 0);  // both times are now, the server's
}

void AttemptLock::end(const AttemptEnd& end) const {
  write_text(
      file(".end"),
      Json{{"ended", end.ended}, {"exit_code", end.exit_code}, {"done", end.done}, {"message", end.message}}
              .dump() +
          "\n");
}

}  // namespace vsglbench
