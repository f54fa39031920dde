#include "method/light_kernel.h"

#include <algorithm>
#include <stdexcept>

namespace vsglbench {
namespace {

class LightKernel : public Method {
 public:
  LightKernel(MethodContext& context, const std::string& file, LightKind kind,
              const std::vector<float>& parameters)
      : kernel_(context.kernel(file, {{"LIGHT", info_of(kind).record}})), kind_(kind) {
    if (parameters.size() > parameters_.size()) throw std::logic_error("a light kernel takes 4 parameters");
    std::copy(parameters.begin(), parameters.end(), parameters_.begin());
  }

  LightKind kind() const override { return kind_; }

  void generate(Steps& steps, const Field& field, const LightTarget& target) override {
    steps.pass("sample", [&] {
      const struct {
        gpu::Emitter emitter;
        uint32_t count, step;
        glm::uvec2 shift;
        std::array<float, 4> parameters;
      } push{field.emitter, target.count, lattice_step(target.count), target.shift, parameters_};
      steps.recorder().dispatch(kernel_, {field.maps, *field.pdf, *target.buffer}, push,
                                groups_for(target.count, 64));
    });
  }

 private:
  const Kernel& kernel_;
  LightKind kind_;
  std::array<float, 4> parameters_{};
};

}  // namespace

uint32_t lattice_step(uint32_t count) { return static_cast<uint32_t>((uint64_t{1} << 32) / count); }

std::unique_ptr<Method> make_light_kernel(MethodContext& context, const std::string& kernel_file,
                                          LightKind kind, const std::vector<float>& parameters) {
  return std::make_unique<LightKernel>(context, kernel_file, kind, parameters);
}

}  // namespace vsglbench
