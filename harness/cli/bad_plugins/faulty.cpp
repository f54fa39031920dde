// One method for many faults: `fault` names what it does while it records its second frame, or what it is.
// The environment's VSGLBENCH_TEST_MISTAKE puts a mistake into what it says of itself.
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "method/plugin.h"

namespace vsglbench {
namespace {

// To every pipe that this programme opened to write.
void write_to_pipes(const std::string& bytes) {
  for (int fd = 3; fd < 1024; ++fd) {
    struct stat status {};
    if (::fstat(fd, &status) != 0 || !S_ISFIFO(status.st_mode)) continue;
    if ((::fcntl(fd, F_GETFD) & FD_CLOEXEC) == 0) continue;
    if ((::fcntl(fd, F_GETFL) & O_ACCMODE) == O_WRONLY && ::write(fd, bytes.data(), bytes.size()) < 0) return;
  }
}

// A process that holds all the descriptors and outlives the one that started it.
void start_process() {
  const pid_t pid = ::fork();
  if (pid == 0) {
    for (;;) ::pause();
  }
  if (const char* file = std::getenv("VSGLBENCH_TEST_PID")) std::ofstream(file) << pid;
}

void do_harm(const std::string& fault, Steps& steps) {
  if (fault == "garbage") write_to_pipes("a line of garbage\n");
  if (fault == "forged") write_to_pipes("{\"done\":true}\n");
  if (fault == "closes") {
    for (int fd = 3; fd < 1024; ++fd) ::close(fd);
    for (;;) ::pause();
  }
  if (fault == "orphan") {
    start_process();
    ::raise(SIGKILL);
  }
  if (fault == "holds") {
    start_process();
    for (;;) ::pause();
  }
  if (fault == "bad-pass") steps.pass("Build Tree", [] {});
  if (fault == "nested-pass") steps.pass("outer", [&] { steps.pass("inner", [] {}); });
  if (fault == "folder" && ::chdir("/") != 0) throw std::runtime_error("chdir");
  if (fault == "long-error") {
    std::string message = "told\t\x1b[31mand so on";
    while (message.size() < 5 << 20) message += " and so on";
    throw std::runtime_error(message);
  }
}

class Faulty : public Method {
 public:
  explicit Faulty(std::string fault) : fault_(std::move(fault)) {}
  LightKind kind() const override {
    return fault_ == "no-kind" ? static_cast<LightKind>(7) : LightKind::vsgl;
  }
  bool uses_importance() const override { return false; }
  uint32_t light_count(uint32_t wanted, uint64_t) const override {
    return fault_ == "no-lights" ? 0 : wanted;
  }
  void generate(Steps& steps, const Field&, const LightTarget& target) override {
    if (++calls_ == 2) do_harm(fault_, steps);
    const auto record = [&] { steps.recorder().fill(*target.buffer, 0); };
    if (fault_ == "raw-pass")
      return steps.recorder().pass({PassStage::generate, Half::rsm, "Build Tree"}, record);
    steps.pass("clear", record);
  }

 private:
  std::string fault_;
  int calls_ = 0;
};

MethodInfo describe() {
  const char* given = std::getenv("VSGLBENCH_TEST_MISTAKE");
  const std::string mistake = given ? given : "";
  MethodInfo info{.summary = "does what its parameter says", .source = "-"};
  info.parameters = {
      {.name = "fault",
       .default_value = "none",
       .description = "what it does wrong",
       .choices = {"none", "garbage", "forged", "closes", "orphan", "holds", "bad-pass", "nested-pass",
                   "raw-pass", "folder", "long-error", "no-kind", "no-lights", "no-method"}},
      {.name = "size", .default_value = 1.0, .description = "-", .minimum = 0, .maximum = 2}};
  if (mistake == "maximum") info.parameters[1].maximum = std::numeric_limits<double>::infinity();
  if (mistake == "minimum") info.parameters[1].minimum = std::numeric_limits<double>::quiet_NaN();
  if (mistake == "flux_bound") info.flux_bound = std::numeric_limits<double>::quiet_NaN();
  if (mistake == "garbage") write_to_pipes("{\"index\":0,\"method\":{}}\n");
  info.create = [](MethodContext&, const Json& parameters) -> std::unique_ptr<Method> {
    const std::string fault = parameters.at("fault");
    if (fault == "no-method") return nullptr;
    return std::make_unique<Faulty>(fault);
  };
  return info;
}

}  // namespace
}  // namespace vsglbench

VSGLBENCH_METHOD(describe())
