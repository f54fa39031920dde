#include "base/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/log.h"

namespace vsglbench {

std::string format_duration(double seconds) {
  const auto s = std::lround(std::clamp(seconds, 0.0, 1e9));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
}

Progress::Progress(std::string text, uint64_t total, double line_every_s)
    : label_(std::move(text)),
      total_(std::max<uint64_t>(total, 1)),
      terminal_(::isatty(STDERR_FILENO)),
      every_s_(terminal_ ? 0.1 : line_every_s),
      start_(std::chrono::steady_clock::now()),
      shown_(terminal_ ? std::chrono::steady_clock::time_point() : start_) {}

Progress::~Progress() {
  if (terminal_) fmt::print(stderr, "\r\x1b[K");
}

void Progress::advance(uint64_t steps) {
  std::lock_guard lock(mutex_);
  done_ = std::min(done_ + steps, total_);
  show();
}

void Progress::label(std::string text) {
  std::lock_guard lock(mutex_);
  label_ = std::move(text);
  show();
}

void Progress::show() {
  const auto now = std::chrono::steady_clock::now();
  const bool is_due = std::chrono::duration<double>(now - shown_).count() >= every_s_;
  if (!is_due && !(terminal_ && done_ == total_)) return;
  shown_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double fraction = static_cast<double>(done_) / static_cast<double>(total_);
  const std::string left =
      done_ == 0 ? "" : fmt::format("{} left", format_duration(elapsed / fraction * (1 - fraction)));
  if (terminal_) return draw(fraction, left);
  log_info("{:.0f} %{}{}: {}", 100 * fraction, left.empty() ? "" : ", ", left, label_);
}

void Progress::draw(double fraction, const std::string& left) {
  constexpr int width = 30;
  const int filled = static_cast<int>(fraction * width);
  fmt::print(stderr, "\r\x1b[K[{:=<{}}{: <{}}] {:3.0f} %{}{}  {}", "", filled, "", width - filled,
             100 * fraction, left.empty() ? "" : "  ", left, label_);
  std::fflush(stderr);
}

}  // namespace vsglbench
