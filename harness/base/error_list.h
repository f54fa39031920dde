// Several things wrong with one file at once.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/error.h"

namespace vsglbench {

// Each is a line of its own, as Error has it; what() has them all on one.
class ErrorList : public Error {
 public:
  ErrorList(ErrorKind kind, std::vector<std::string> lines)
      : Error(kind, fmt::format("{}", fmt::join(lines, "; "))), lines_(std::move(lines)) {}
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::vector<std::string> lines_;
};

}  // namespace vsglbench
