// Tests only: methods run on made-up halves, without a scene.
#pragma once

#include <gtest/gtest.h>

#include <random>

#include "base/file.h"
#include "method/filtered_sampling.h"
#include "method/lattice.h"
#include "method/made_half.h"
#include "method/registry.h"

namespace vsglbench {

inline Device& test_device() {
  static Device device;
  return device;
}

// Runs `method` on `half` and returns its lights.
class MethodBench {
 public:
  explicit MethodBench(const std::string& method, const Json& parameters = Json::object())
      : kernels_(test_device()),
        scratch_(test_device()),
        recorder_(test_device()),
        info_(load_method(method, test_device().info())),
        context_(kernels_, scratch_, info_.folder),
        method_(info_.create(context_, resolve_parameters(info_, parameters))) {}

  template <class Light>
  std::vector<Light> lights(const oracle::Half& half, uint32_t count, glm::uvec2 shift = {0, 0},
                            const CarriedState& carried = {}) {
    const DeviceHalf on_device(test_device(), half);
    Buffer out(test_device(), "lights", count * sizeof(Light));
    recorder_.begin();
    Steps steps(recorder_, Half::rsm);
    method_->generate(steps, on_device.field(Half::rsm), {&out, count, shift, carried});
    recorder_.submit_and_wait();
    return out.download<Light>(count);
  }

  const MethodInfo& info() const { return info_; }

 private:
  KernelLibrary kernels_;
  ScratchPool scratch_;
  Recorder recorder_;
  const MethodInfo& info_;
  MethodContext context_;
  std::unique_ptr<Method> method_;
};

}  // namespace vsglbench
