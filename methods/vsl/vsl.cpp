// Virtual spherical lights: N texels drawn by warping the PDF, each a sphere with the radius of its k nearest
// neighbours (Hašan et al. 2009; [VSGL14] Eq. 2).
#include <algorithm>

#include "gpu/limits.h"
#include "method/light_kernel.h"
#include "method/plugin.h"

namespace vsglbench {
namespace {

class SphericalLights : public Method {
 public:
  SphericalLights(MethodContext& context, const Json& parameters)
      : context_(context),
        points_(make_light_kernel(context, "vsl_points.comp", LightKind::vsl,
                                  {parameters.at("samples").get<float>()})),
        radii_(context.kernel("vsl_radii.comp")),
        neighbours_(parameters.at("k").get<uint32_t>()),
        scale_(parameters.at("radius_scale").get<float>()) {}

  LightKind kind() const override { return LightKind::vsl; }

  void generate(Steps& steps, const Field& field, const LightTarget& target) override {
    points_->generate(steps, field, target);
    // As importance, lights count as points: the eye's have no radius.
    if (field.half == Half::gbuffer) return;
    // Each dispatch looks at a range of the lights, and carries on with the nearest so far. A light that is
    // nearer than all before it takes k rounds more; what is left of limits::loop_rounds is for other loops.
    const uint32_t most = 60000 / (neighbours_ + 1);
    static_assert(60000 < limits::loop_rounds);
    const Buffer& nearest =
        context_.scratch("vsl.nearest", size_t(target.count) * neighbours_ * sizeof(float));
    Recorder& r = steps.recorder();
    steps.pass("radii", [&] {
      for (uint32_t first = 0; first < target.count; first += most) {
        const struct {
          uint32_t count, first, last, neighbours;
          float scale;
        } push{target.count, first, std::min(first + most, target.count), neighbours_, scale_};
        if (first > 0) r.barrier();
        r.dispatch(radii_, {*target.buffer, nearest}, push, groups_for(target.count, 64));
      }
    });
  }

 private:
  MethodContext& context_;
  std::unique_ptr<Method> points_;
  const Kernel& radii_;
  uint32_t neighbours_;
  float scale_;
};

}  // namespace
}  // namespace vsglbench

VSGLBENCH_METHOD(MethodInfo{
    .summary =
        "virtual spherical lights: exact BRDFs over the cone towards a sphere, by Monte-Carlo with MIS",
    .source = "Hašan et al. 2009; [VSGL14] Eq. 2",
    .makes_vpls = Json::object(),
    .parameters = {{"k", 10, "neighbours whose distance is the radius", 1, 32, {}},
                   {"radius_scale", 1.0, "times that distance", 1e-6, 1e6, {}},
                   {"samples",
                    8.0,
                    "of each strategy, under a half angle of 90°; fewer in proportion below",
                    1,
                    1024,
                    {}}},
    .flux_bound = 0.01,
    .create = [](MethodContext& context, const Json& parameters) -> std::unique_ptr<Method> {
      return std::make_unique<SphericalLights>(context, parameters);
    }})
