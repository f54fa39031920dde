// my-method: one VSGL from each tile of the half, whose texels one workgroup sums.
#include <algorithm>
#include <cmath>

#include "method/plugin.h"

namespace vsglbench {
namespace {

class TileSums : public Method {
 public:
  TileSums(MethodContext& context, float blur) : sum_(context.kernel("my_method.comp")), blur_(blur) {}
  LightKind kind() const override { return LightKind::vsgl; }
  bool uses_importance() const override { return false; }

  void generate(Steps& steps, const Field& field, const LightTarget& target) override {
    // About square tiles.
    const auto& e = field.emitter;
    const double rows = std::sqrt(double(target.count) * e.height / e.width);
    const struct {
      gpu::Emitter emitter;
      uint32_t count, rows;
      glm::vec2 shift;
      float blur;
    } push{e, target.count, std::clamp(uint32_t(rows), 1u, std::min(target.count, 1024u)),
           glm::vec2(target.shift >> 8u) / 16777216.0f, blur_};
    // One workgroup a light; a device may allow no more than 65535 of them in one dimension.
    const uint32_t groups_y = groups_for(target.count, 65535);
    steps.pass("sum", [&] {
      steps.recorder().dispatch(sum_, {field.maps, *target.buffer}, push, groups_for(target.count, groups_y),
                                groups_y);
    });
  }

 private:
  const Kernel& sum_;
  float blur_;
};

}  // namespace
}  // namespace vsglbench

VSGLBENCH_METHOD(MethodInfo{
    .summary = "my-method: one tile of texels a light, summed by a workgroup",
    .source = "-",
    .parameters = {{"blur", 1.0, "variance of a light, as a part of that of its texels", 0.0, 100.0, {}}},
    .flux_bound = 1e-4,
    .create = [](MethodContext& context, const Json& parameters) -> std::unique_ptr<Method> {
      return std::make_unique<TileSums>(context, parameters.at("blur").get<float>());
    }})
