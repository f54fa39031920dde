// A method that makes black lights, and does `harm` while it records the generation of one frame: the second,
// or that of its parameter `frame`.
#pragma once

#include "method/plugin.h"

namespace vsglbench {

class BadMethod : public Method {
 public:
  BadMethod(void (*harm)(), const Json& parameters) : harm_(harm), frame_(parameters.at("frame")) {}
  LightKind kind() const override { return LightKind::vsgl; }
  bool uses_importance() const override { return false; }
  void generate(Steps& steps, const Field&, const LightTarget& target) override {
    if (++calls_ == frame_) harm_();
    steps.pass("clear", [&] { steps.recorder().fill(*target.buffer, 0); });
  }

 private:
  void (*harm_)();
  const int frame_;
  int calls_ = 0;
};

inline MethodInfo bad_method(const char* summary,
                             std::unique_ptr<Method> (*create)(MethodContext&, const Json&)) {
  return {
      .summary = summary,
      .source = "-",
      .parameters = {{.name = "frame", .default_value = 2, .description = "-", .minimum = 1, .maximum = 9}},
      .create = create};
}

}  // namespace vsglbench
