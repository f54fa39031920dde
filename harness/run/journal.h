// What a run has found since its report was last written, one line a message: whatever ends the process loses
// no more than what was on its way.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json.h"

namespace vsglbench {

class Journal {
 public:
  // `created`: of the report that it is about. What lies there of another report is of no use, and goes with
  // the first restart().
  Journal(std::filesystem::path path, std::string created);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  // What was appended since the last restart(), by this process or an earlier one. A line that was cut off is
  // passed over, with a warning.
  std::vector<Json> read() const;
  // Throws Error(output), like restart().
  void append(const Json& message);
  // Empties it, once the report holds what it says.
  void restart();
  // When the run is complete.
  void remove();

 private:
  void open(int flags);
  std::filesystem::path path_;
  std::string created_;
  int file_ = -1;
};

}  // namespace vsglbench
