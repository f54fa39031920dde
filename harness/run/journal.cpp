#include "run/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "base/log.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr const char* kSchema = "vsglbench.journal/1";

void write_all(int file, const std::string& text, const fs::path& path) {
  for (size_t at = 0; at < text.size();) {
    const ssize_t n = ::write(file, text.data() + at, text.size() - at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0)
      throw fail(ErrorKind::output, "{}: can't be written: {}", path.string(), std::strerror(errno));
    at += static_cast<size_t>(n);
  }
}

// Links are not followed, and pipes not waited for.
bool is_file_or_absent(const fs::path& path) {
  std::error_code ec;
  const fs::file_type type = fs::symlink_status(path, ec).type();
  return type == fs::file_type::regular || type == fs::file_type::not_found;
}

}  // namespace

Journal::~Journal() {
  if (file_ >= 0) ::close(file_);
}

void Journal::open(int flags) {
  if (file_ >= 0) ::close(file_);
  if (!is_file_or_absent(path_))
    throw fail(ErrorKind::output, "{}: is no plain file; remove it", path_.string());
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | flags, 0644);
  if (file_ < 0)
    throw fail(ErrorKind::output, "{}: can't be written: {}", path_.string(), std::strerror(errno));
}

Json Journal::header() const {
  if (!is_file_or_absent(path_)) return {};
  std::ifstream file(path_, std::ios::binary);
  std::string line;
  std::getline(file, line);
  const Json json = Json::parse(line, nullptr, false);
  const bool is_ours = json.is_object() && json.contains("schema") && json["schema"] == kSchema;
  return is_ours && json.contains("about") ? json["about"] : Json();
}

bool Journal::is_empty() const {
  if (!is_file_or_absent(path_)) return true;
  std::ifstream file(path_, std::ios::binary);
  std::string line;
  std::getline(file, line);
  return file.peek() == std::ifstream::traits_type::eof();
}

std::vector<Json> Journal::read() const {
  std::vector<Json> messages;
  std::ifstream file(path_, std::ios::binary);
  size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    if (++number == 1) continue;  // the header
    Json json = Json::parse(line, nullptr, false);
    if (json.is_discarded()) {
      log_warning("{}:{}: no JSON; what it told is measured again", path_.string(), number);
    } else {
      messages.push_back(std::move(json));
    }
  }
  return messages;
}

void Journal::append(const Json& message) {
  if (file_ < 0) open(0);
  // A line that was cut off ends here.
  char last = '\n';
  const off_t size = ::lseek(file_, 0, SEEK_END);
  const bool cut = size > 0 && ::pread(file_, &last, 1, size - 1) == 1 && last != '\n';
  write_all(file_, (cut ? "\n" : "") + message.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n",
            path_);
}

void Journal::restart(const Json& header) {
  open(O_TRUNC);
  append({{"schema", kSchema}, {"about", header}});
}

void Journal::remove() {
  std::error_code ec;
  fs::remove(path_, ec);
}

}  // namespace vsglbench
