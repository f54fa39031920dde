// Virtual point lights: N texels drawn by warping the PDF (Keller 1997; [VSGL14] Eq. 1).
#include "method/filtered_sampling.h"
#include "method/plugin.h"

namespace vsglbench {
namespace {

class Vpls : public Method {
 public:
  explicit Vpls(MethodContext& context) : sample_(context.kernel("vpl.comp")) {}
  LightKind kind() const override { return LightKind::vpl; }

  void generate(Steps& steps, const Field& field, const LightTarget& target) override {
    steps.pass("sample", [&] {
      const struct {
        gpu::Emitter emitter;
        uint32_t count, step;
        glm::uvec2 shift;
      } push{field.emitter, target.count, lattice_step(target.count), target.shift};
      const auto& maps = field.maps;
      steps.recorder().dispatch(
          sample_, {*maps[0], *maps[1], *maps[2], *maps[3], *maps[4], *field.pdf, *target.buffer}, push,
          groups_for(target.count, 64));
    });
  }

 private:
  const Kernel& sample_;
};

}  // namespace
}  // namespace vsglbench

VSGLBENCH_METHOD(MethodInfo{.summary = "virtual point lights, exact BRDFs, no filtering, no clamping",
                            .source = "Keller 1997; [VSGL14] Eq. 1",
                            .parameters = {},
                            .create = [](MethodContext& context, const Json&) -> std::unique_ptr<Method> {
                              return std::make_unique<Vpls>(context);
                            }})
