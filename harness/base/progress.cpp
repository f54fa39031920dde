#include "base/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "base/log.h"
#include "base/printable.h"

namespace vsglbench {
namespace {

// Columns of the terminal that takes standard error; 80 where it does not say.
size_t columns_of_stderr() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

bool is_dumb() {
  const char* term = std::getenv("TERM");
  return term != nullptr && std::string_view(term) == "dumb";
}

}  // namespace

std::string progress_bar(double fraction, const std::string& left, const std::string& label, size_t columns) {
  constexpr int width = 30;
  const int filled = static_cast<int>(fraction * width);
  const std::string bar =
      printable(fmt::format("[{:=<{}}{: <{}}] {:3.0f} %{}{}  {}", "", filled, "", width - filled,
                            100 * fraction, left.empty() ? "" : "  ", left, label));
  // The last column stays free: a character there makes some terminals begin a new line.
  std::string out;
  size_t used = 0;
  for (const char c : bar) {
    used += (c & 0xC0) != 0x80;
    if (used + 1 > columns) break;
    out += c;
  }
  return out;
}

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
      silent_(terminal_ && is_dumb()),
      every_s_(terminal_ ? 0.1 : line_every_s),
      start_(std::chrono::steady_clock::now()),
      shown_(terminal_ ? std::chrono::steady_clock::time_point() : start_) {}

Progress::~Progress() {
  if (terminal_ && !silent_) fmt::print(stderr, "\r\x1b[K");
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
  if (silent_) return;
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
  fmt::print(stderr, "\r\x1b[K{}", progress_bar(fraction, left, label_, columns_of_stderr()));
  std::fflush(stderr);
}

}  // namespace vsglbench
