#include "run/report_store.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "base/file.h"
#include "base/log.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

bool same_machine(const DeviceReport& a, const DeviceReport& b) {
  return a.name == b.name && a.driver_version == b.driver_version && a.settings == b.settings;
}

bool same_run(const Report& a, const Report& b) {
  return a.config == b.config && a.git.commit == b.git.commit && a.git.dirty == b.git.dirty &&
         a.kernels == b.kernels && same_machine(a.device, b.device);
}

// False when somebody else holds it. A worker whose command was killed a moment ago may hold it a moment
// longer.
bool take(int lock) {
  for (int attempt = 0; ::flock(lock, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; ++attempt) {
    if (attempt == 20) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

void move(const fs::path& from, const fs::path& to) {
  std::error_code ec;
  fs::rename(from, to, ec);
  if (ec)
    throw fail(ErrorKind::output, "{}: can't be moved to {}: {}", from.string(), to.string(), ec.message());
}

}  // namespace

ReportStore::ReportStore(const fs::path& folder)
    : folder_(folder), path_(folder / "report.json"), journal_(folder / "report.journal") {
  ensure_writable_directory(folder_);
  std::error_code ec;
  if (fs::is_directory(path_, ec))
    throw fail(ErrorKind::output, "{}: is a folder; remove it", path_.string());
  lock_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0 && !take(lock_)) {
    ::close(lock_);
    throw fail(ErrorKind::output, "{}: another run is writing there; wait for it or give another --out",
               folder_.string());
  }
}

ReportStore::~ReportStore() {
  if (lock_ >= 0) ::close(lock_);  // gives the lock back, too
}

void ReportStore::leave_to_parent() {
  if (lock_ >= 0) ::close(lock_);
  lock_ = -1;
}

// The journal's own run, where that is the same.
std::optional<Report> ReportStore::begun(const Report& fresh) const {
  const Json header = journal_.header();
  if (header.is_null()) return std::nullopt;
  try {
    Report report = report_from_json(header);
    if (same_run(report, fresh)) return report;
  } catch (const std::exception&) {  // damaged
  }
  return std::nullopt;
}

Report ReportStore::open(const Report& fresh, bool anew) {
  std::error_code ec;
  std::optional<Report> earlier = anew ? std::nullopt : begun(fresh);
  if (fs::exists(path_, ec)) {
    try {
      Report saved = read_report(path_);
      // The journal of a run that has saved a scene is of that run.
      if (!anew && !saved.complete && same_run(saved, fresh)) {
        goes_on_ = earlier && earlier->created == saved.created;
        earlier = std::move(saved);
        earlier->argv = fresh.argv;
        return *earlier;
      }
      aside_ = folder_ / (saved.complete ? "report.previous.json" : "report.incomplete.json");
    } catch (const Error& e) {
      log_warning("{}; it is kept as report.damaged.json", e.what());
      aside_ = folder_ / "report.damaged.json";
    }
  }
  goes_on_ = earlier.has_value();
  if (!earlier) return fresh;
  earlier->argv = fresh.argv;
  return *earlier;
}

void ReportStore::forget_notes(const Report& report) {
  Report empty = report;
  empty.cases.clear();
  empty.scenes.clear();
  empty.aa.clear();
  empty.analysis = Json();
  journal_.restart(to_json(empty));
}

void ReportStore::close() {
  journal_.remove();
  std::error_code ec;
  std::vector<fs::path> left;  // as write_atomically() names them: .NAME.PID.SERIAL.tmp.EXTENSION
  for (fs::recursive_directory_iterator at(folder_ / "images", ec), end; !ec && at != end; at.increment(ec)) {
    const std::string name = at->path().filename().string();
    if (name.starts_with('.') && name.find(".tmp") != std::string::npos) left.push_back(at->path());
  }
  for (const fs::path& path : left) fs::remove(path, ec);
}

void ReportStore::save(const Report& report) {
  if (!aside_) return write_report(path_, report);
  const fs::path next = folder_ / ".report.next.json";
  write_report(next, report);  // whatever can fail for want of space fails here
  move(path_, *aside_);
  move(next, path_);
  aside_.reset();
}

}  // namespace vsglbench
