#include "run/report_store.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <thread>

#include "base/file.h"
#include "base/log.h"
#include "run/scene_images.h"

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

// A case that has what a report tells of it: its numbers, and its pictures on the disk.
bool is_whole(const CaseResult& c, const fs::path& folder) {
  std::error_code ec;
  return c.status == Status::ok && std::ranges::all_of(c.images, [&](const auto& image) {
           return fs::exists(folder / preview_of(image.second), ec);
         });
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

// What the journal says that it is of; nothing where it is damaged, or there is none.
std::optional<Report> ReportStore::begun() const {
  try {
    return report_from_json(journal_.header());
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

// What is saved of the same run; any other report is to be moved aside.
std::optional<Report> ReportStore::saved(const Report& fresh, bool anew, bool again) {
  std::error_code ec;
  if (!fs::exists(path_, ec)) return std::nullopt;
  try {
    Report report = read_report(path_);
    if (!anew && !report.complete && same_run(report, fresh)) return report;
    if (!anew && again && same_run(report, fresh)) {
      std::erase_if(report.cases, [&](const CaseResult& c) { return !is_whole(c, folder_); });
      report.complete = false;
      return report;
    }
    aside_ = folder_ / (report.complete ? "report.previous.json" : "report.incomplete.json");
  } catch (const Error& e) {
    log_warning("{}; it is kept as report.damaged.json", e.what());
    aside_ = folder_ / "report.damaged.json";
  }
  return std::nullopt;
}

std::optional<Report> ReportStore::finished(const Report& fresh) const {
  std::error_code ec;
  if (!fs::exists(path_, ec)) return std::nullopt;
  try {
    Report report = read_report(path_);
    const auto whole = [&](const CaseResult& c) { return is_whole(c, folder_); };
    if (report.complete && same_run(report, fresh) && std::ranges::all_of(report.cases, whole)) return report;
  } catch (const Error&) {  // open() tells of what is damaged
  }
  return std::nullopt;
}

Report ReportStore::open(const Report& fresh, bool anew, bool again) {
  std::optional<Report> earlier = begun();
  if (anew || !earlier || !same_run(*earlier, fresh)) earlier.reset();
  goes_on_ = earlier.has_value();
  if (std::optional<Report> report = saved(fresh, anew, again)) {
    // The journal of a run that has saved a scene is of that run.
    goes_on_ = earlier && earlier->created == report->created;
    earlier = std::move(report);
  }
  if (!goes_on_) keep_journal();
  if (!earlier) return fresh;
  earlier->argv = fresh.argv;
  return *earlier;
}

// One that is not gone on with, where it says anything.
void ReportStore::keep_journal() const {
  if (journal_.is_empty()) return;
  const bool damaged = !begun();
  const fs::path kept = folder_ / (damaged ? "report.damaged.journal" : "report.incomplete.journal");
  move(journal_.path(), kept);
  log_warning("{}: {}; it is kept as {}", journal_.path().string(),
              damaged ? "its first line is damaged" : "of a run that is not gone on with",
              kept.filename().string());
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
  std::vector<fs::path> left;  // as write_atomically() names them: .NAME.HOST.PID.SERIAL.tmp.EXTENSION
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
