#include <csignal>

#include "bad_method.h"

namespace {
const int crash = [] {
  std::signal(SIGABRT, SIG_DFL);
  return std::raise(SIGABRT);
}();
}  // namespace

VSGLBENCH_METHOD(vsglbench::bad_method("crashes while it is loaded", nullptr))
