#include "frame/frame_parts.h"

#include "base/error.h"

namespace vsglbench {
namespace {

const FrameParameters& checked(const FrameParameters& p, const MethodInfo& method) {
  const uint64_t texels = uint64_t(p.rsm) * p.rsm;
  if (method.takes_light_count && (p.lights == 0 || p.lights > texels)) {
    throw fail(ErrorKind::case_failed, "N = {} lights can't be drawn from an RSM of {} texels; use 1 … {}",
               p.lights, texels, texels);
  }
  return p;
}

FrameParameters without_visibility_where_nothing_occludes(FrameParameters p) {
  if (!p.effects.has(Effect::occlusion)) p.visibility = Visibility::none;
  return p;
}

}  // namespace

FrameParts::FrameParts(Stage& s, const MethodInfo& method, const Json& method_parameters,
                       const FrameParameters& p, ExactVisibility exact)
    : stage(s),
      parameters(without_visibility_where_nothing_occludes(p)),
      generator(s, method, method_parameters, p.shading, p.effects, Half::rsm),
      halves(s, p.width, p.height, checked(p, method).rsm, p.effects),
      lights(s, halves, generator, Half::rsm, p.lights),
      shade(s, halves, lights, parameters, std::move(exact)) {
  if (generator.method().uses_importance())
    importance.emplace(s, halves, method, method_parameters, parameters);
}

std::vector<const LightGenerator*> FrameParts::generators() const {
  std::vector<const LightGenerator*> out = {&generator};
  if (parameters.importance == Importance::own && importance_lights())
    out.push_back(&importance_lights()->generator());
  return out;
}

}  // namespace vsglbench
