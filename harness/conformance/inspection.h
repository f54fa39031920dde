// Inside the conformance kit: what a check is given in its own process.
#pragma once

#include <functional>

#include "base/child.h"
#include "conformance/run.h"

namespace vsglbench {

class Inspection {
 public:
  Inspection(Device& device, const MethodInfo& info, bool large, const ToParent& parent)
      : device_(device), info_(info), large_(large), parent_(parent), kernels_(device) {}
  Device& device() { return device_; }
  const MethodInfo& info() const { return info_; }
  bool wants_large() const { return large_; }
  KernelLibrary& kernels() { return kernels_; }

  // A new Method, with kernels that others of this inspection have compiled.
  std::unique_ptr<MethodRun> make(const Json& parameters = Json::object()) {
    return std::make_unique<MethodRun>(kernels_, info_, parameters);
  }
  // Whether the method reads a PDF; the halves that a frame then asks for.
  bool uses_importance();
  std::vector<Half> halves();

  // Tells the parent which input comes, then runs `body`. What `body` throws is a failure of this input, but
  // for a lost device, which ends the check. `large`: a device without room for it leaves it out.
  void on(const std::string& input, const std::function<void()>& body, bool large = false);
  // A fault on the present input: "<what came>; expected <what>".
  void found(const std::string& fault);
  // A figure of the present input, for the report.
  void measured(const std::string& figure);

 private:
  void found_thrown(const std::string& what);
  Device& device_;
  const MethodInfo& info_;
  bool large_;
  const ToParent& parent_;
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
