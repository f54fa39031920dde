// Inside the conformance kit: what a check is given in its own process.
#pragma once

#include <functional>

#include "base/supervise.h"
#include "conformance/conformance.h"
#include "conformance/run.h"

namespace vsglbench {

// What a check tells as it goes.
struct CheckNews {
  enum class Kind { input, failure, left_out, measured };
  Kind kind = Kind::input;
  std::string text;  // as in CheckResult; of an input its name
};
Json to_json(const CheckNews& news);
void from_json(const Json& json, CheckNews* news);

class Inspection {
 public:
  Inspection(Device& device, const MethodInfo& info, const ConformanceOptions& options,
             const Worker<CheckNews>& worker)
      : device_(device), info_(info), options_(options), worker_(worker), kernels_(device) {}
  Device& device() { return device_; }
  const MethodInfo& info() const { return info_; }
  bool wants_large() const { return options_.large; }
  KernelLibrary& kernels() { return kernels_; }

  // A new Method, with kernels that others of this inspection have compiled.
  std::unique_ptr<MethodRun> make(const Json& parameters = Json::object()) {
    return std::make_unique<MethodRun>(kernels_, info_, parameters);
  }
  // Whether the method reads a PDF; the halves that a frame then asks for.
  bool uses_importance();
  std::vector<Half> halves();

  // Tells which input comes, then runs `body`. What `body` throws is a failure of this input, but
  // for a lost device, which ends the check. `large`: a device without room for it leaves it out.
  void on(const std::string& input, const std::function<void()>& body, bool large = false);
  // A fault on the present input: "<what came>; expected <what>".
  void found(const std::string& fault);
  // A figure of the present input, for the report.
  void measured(const std::string& figure);

 private:
  void found_thrown(const std::string& what);
  void tell(CheckNews::Kind kind, const std::string& text);
  Device& device_;
  const MethodInfo& info_;
  const ConformanceOptions& options_;
  const Worker<CheckNews>& worker_;
  KernelLibrary kernels_;
  std::string input_;
  std::string thrown_;  // last
};

struct ConformanceCheck {
  const char* name;
  void (*run)(Inspection&);
  bool validation = false;  // on a device with validation layers
};

void check_image(Inspection& inspection);  // of whole frames; the others are in conformance_checks.cpp
const std::vector<ConformanceCheck>& all_conformance_checks();

}  // namespace vsglbench
