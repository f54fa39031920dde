// What a run has found since its report was last written, one line a message: whatever ends the process loses
// no more than what was on its way.
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "base/json.h"

namespace vsglbench {

class Journal {
 public:
  explicit Journal(std::filesystem::path path) : path_(std::move(path)) {}
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  const std::filesystem::path& path() const { return path_; }
  // What it is about, as restart() was told; null where there is no journal.
  Json header() const;
  bool is_empty() const;  // no more than a header, sound or not
  // What was appended since the last restart(), by this process or an earlier one. A line that was cut off is
  // passed over, with a warning.
  std::vector<Json> read() const;
  // Throws Error(output), like restart().
  void append(const Json& message);
  // Empties it: at the start of a run, and once a report holds what it says.
  void restart(const Json& header);
  // When the run is complete.
  void remove();

 private:
  void open(int flags);
  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace vsglbench
