// Methods that go wrong: what their host sides share.
#pragma once

#include "method/plugin.h"

namespace vsglbench {

// Makes black lights, and does `harm` while it records the generation of one frame: the second, or that of
// its parameter `frame`.
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

// Makes VSGLs by one dispatch of a kernel of its own.
class BadKernel : public Method {
 public:
  using Dispatch = void (*)(Recorder&, const Kernel&, const Field&, const LightTarget&);
  BadKernel(const Kernel& kernel, Dispatch dispatch) : kernel_(kernel), dispatch_(dispatch) {}
  LightKind kind() const override { return LightKind::vsgl; }
  bool uses_importance() const override { return false; }
  void generate(Steps& steps, const Field& field, const LightTarget& target) override {
    steps.pass("write", [&] { dispatch_(steps.recorder(), kernel_, field, target); });
  }

 private:
  const Kernel& kernel_;
  Dispatch dispatch_;
};

// Binds maps and lights, and pushes emitter and count.
inline void dispatch_on_texels(Recorder& recorder, const Kernel& kernel, const Field& field,
                               const LightTarget& target) {
  const struct {
    gpu::Emitter emitter;
    uint32_t count;
  } push{field.emitter, target.count};
  recorder.dispatch(kernel, {field.maps, *target.buffer}, push, groups_for(target.count, 64));
}

inline MethodInfo bad_method(const char* summary,
                             std::unique_ptr<Method> (*create)(MethodContext&, const Json&)) {
  return {
      .summary = summary,
      .source = "-",
      .parameters = {{.name = "frame", .default_value = 2, .description = "-", .minimum = 1, .maximum = 9}},
      .create = create};
}

}  // namespace vsglbench
