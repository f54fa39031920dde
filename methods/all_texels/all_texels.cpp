// Every RSM texel a light: the clustering-free answer, with exact BRDFs or with SG lobes.
#include "method/plugin.h"

namespace vsglbench {
namespace {

class AllTexels : public Method {
 public:
  AllTexels(MethodContext& context, bool exact)
      : exact_(exact), convert_(context.kernel("all_texels.comp", {{"EXACT", exact ? "1" : "0"}})) {}
  LightKind kind() const override { return exact_ ? LightKind::vpl : LightKind::vsgl; }
  bool uses_importance() const override { return false; }
  uint32_t light_count(uint32_t, uint64_t texels) const override { return static_cast<uint32_t>(texels); }

  void generate(Steps& steps, const Field& field, const LightTarget& target) override {
    steps.pass("convert", [&] {
      steps.recorder().dispatch(convert_, {field.maps, *target.buffer}, field.emitter,
                                groups_for(field.emitter.width, 8), groups_for(field.emitter.height, 8));
    });
  }

 private:
  bool exact_;
  const Kernel& convert_;
};

}  // namespace
}  // namespace vsglbench

VSGLBENCH_METHOD(MethodInfo{
    .summary = "every RSM texel a light: the answer without clustering",
    .source = "-",
    .takes_light_count = false,
    .makes_vpls = {{"shading", "exact"}},
    .parameters = {{"shading",
                    "exact",
                    "exact: both BRDFs; vsgl16, vsgl14: each texel's SG lobes [MFIS16 App. C; VSGL14 §3.1]; "
                    "filtered: both BRDFs under a disk as large as the texel",
                    0,
                    0,
                    {"exact", "vsgl16", "vsgl14", "filtered"}}},
    .flux_bound = 1e-5,
    .light_rule = LightRule::texel,
    .create = [](MethodContext& context, const Json& parameters) -> std::unique_ptr<Method> {
      return std::make_unique<AllTexels>(context, parameters.at("shading") == "exact");
    }})
