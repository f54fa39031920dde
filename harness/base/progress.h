// A progress bar with the time left, on a terminal; elsewhere a line of the log now and then. A terminal that
// can't move its cursor (TERM=dumb) gets nothing.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>

namespace vsglbench {

class Progress {
 public:
  Progress(std::string label, uint64_t total, double line_every_s = 10);
  ~Progress();                       // clears the bar's line
  void advance(uint64_t steps = 1);  // any thread
  void label(std::string text);

 private:
  void show();
  void draw(double fraction, const std::string& left);
  std::string label_;
  uint64_t total_, done_ = 0;
  bool terminal_, silent_;
  double every_s_;  // between two bars or lines
  std::chrono::steady_clock::time_point start_, shown_;
  std::mutex mutex_;
};

// A bar on one line of a terminal that is so many columns wide.
std::string progress_bar(double fraction, const std::string& left, const std::string& label, size_t columns);

// "3 s", "2 min 5 s", "1 h 3 min".
std::string format_duration(double seconds);

}  // namespace vsglbench
