// The report.json of an output folder: resumed, saved, and never lost.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "report/report.h"
#include "run/journal.h"

namespace vsglbench {

// One run's hold on an output folder. What an earlier run left there is moved aside when the first new report
// is safely on the disk: a complete one to report.previous.json, one of an interrupted run that is not gone
// on with to report.incomplete.json, a damaged one to report.damaged.json. A journal that is not gone on with
// is moved aside at once, to report.incomplete.journal or report.damaged.journal.
class ReportStore {
 public:
  // Creates the folder. Throws Error(output) when it can't be written to, or another run is writing there.
  explicit ReportStore(const std::filesystem::path& folder);
  ~ReportStore();
  ReportStore(const ReportStore&) = delete;
  ReportStore& operator=(const ReportStore&) = delete;

  // What to go on with: the report of an interrupted run of the same experiment, program and device, saved
  // already or only begun; else `fresh`, and always so with `anew`.
  // `again`: a complete report of the same run is gone on with, too, without its failed and skipped cases,
  // and those whose pictures are not on the disk.
  Report open(const Report& fresh, bool anew, bool again = false);
  // A complete report of the same experiment, program and device, all of whose cases are ok and have their
  // pictures on the disk.
  std::optional<Report> finished(const Report& fresh) const;
  // In a child process: closes its copy of the lock, which is the parent's alone. Without it a child that
  // dies a moment after the parent would keep the next run out.
  void leave_to_parent();
  // Throws Error(output); then the earlier report stands where it stood.
  void save(const Report& report);
  const std::filesystem::path& path() const { return path_; }

  // Beside the report, what it does not hold yet of the run that open() said to go on with.
  std::vector<Json> noted() const { return goes_on_ ? journal_.read() : std::vector<Json>(); }
  void note(const Json& news) { journal_.append(news); }
  // The notes are in the report now, or there are none to go on with.
  void forget_notes(const Report& report);
  // The run is complete: takes away the journal, and half-written files that killed processes have left.
  void close();

 private:
  std::optional<Report> begun() const;
  std::optional<Report> saved(const Report& fresh, bool anew, bool again);
  void keep_journal() const;
  std::filesystem::path folder_, path_;
  std::optional<std::filesystem::path> aside_;  // where the earlier report goes at the next save
  Journal journal_;
  bool goes_on_ = false;
  int lock_ = -1;
};

}  // namespace vsglbench
