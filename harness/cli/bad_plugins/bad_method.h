// A method that makes black lights, and does `harm` while it records its second frame's generation.
#pragma once

#include "method/plugin.h"

namespace vsglbench {

class BadMethod : public Method {
 public:
  explicit BadMethod(void (*harm)()) : harm_(harm) {}
  LightKind kind() const override { return LightKind::vsgl; }
  bool uses_importance() const override { return false; }
  void generate(Steps& steps, const Field&, const LightTarget& target) override {
    if (++calls_ == 2) harm_();
    steps.pass("clear", [&] { steps.recorder().fill(*target.buffer, 0); });
  }

 private:
  void (*harm_)();
  int calls_ = 0;
};

inline MethodInfo bad_method(const char* summary,
                             std::unique_ptr<Method> (*create)(MethodContext&, const Json&)) {
  return {.summary = summary, .source = "-", .create = create};
}

}  // namespace vsglbench
