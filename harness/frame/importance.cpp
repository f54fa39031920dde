#include "frame/importance.h"

#include <algorithm>

#include "base/error.h"
#include "base/nearest.h"
#include "frame/light_ranges.h"
#include "method/filtered_sampling.h"
#include "method/registry.h"

namespace vsglbench {
namespace {

// The member of an enumeration that `names` lists in its order. Throws Error(config), naming the nearest.
template <class Enum>
Enum named(const char* what, const std::string& name, const std::vector<std::string>& names) {
  const auto it = std::ranges::find(names, name);
  if (it != names.end()) return static_cast<Enum>(it - names.begin());
  throw fail(ErrorKind::config, "no {} '{}'{}", what, name, suggestion(name, names));
}

}  // namespace

const std::vector<std::string>& importance_names() {
  static const std::vector<std::string> names = {"own", "vsgl", "vpl", "flux"};
  return names;
}

Importance parse_importance(const std::string& name) {
  return named<Importance>("importance", name, importance_names());
}

const std::vector<std::string>& importance_norm_names() {
  static const std::vector<std::string> names = {"l1", "l2"};
  return names;
}

ImportanceNorm parse_importance_norm(const std::string& name) {
  return named<ImportanceNorm>("importance norm", name, importance_norm_names());
}

const std::vector<std::string>& lattice_names() {
  static const std::vector<std::string> names = {"fixed", "shifted"};
  return names;
}

Lattice parse_lattice(const std::string& name) { return named<Lattice>("lattice", name, lattice_names()); }

ImportancePass::ImportancePass(Stage& stage, const Halves& halves, const MethodInfo& own,
                               const Json& method_parameters, const FrameParameters& p)
    : stage_(stage), halves_(halves), shading_(p.shading), effects_(p.effects), norm_(p.importance_norm) {
  if (p.importance == Importance::flux) return;
  const auto make = [&](const MethodInfo& info, const Json& parameters) {
    generator_ = std::make_unique<LightGenerator>(stage, info, parameters, shading_, effects_, Half::gbuffer);
  };
  if (p.importance == Importance::own) {
    make(own, method_parameters);
  } else {
    const LightKind kind = p.importance == Importance::vsgl ? LightKind::vsgl : LightKind::vpl;
    const MethodInfo& info = load_method(find_importance_maker(kind).name, stage.device.info());
    make(info, resolve_parameters(info, Json::object()));
  }
  const auto wanted = std::clamp<uint64_t>(p.importance_lights, 1, halves.texels(Half::gbuffer));
  lights_.emplace(stage, halves, *generator_, Half::gbuffer, static_cast<uint32_t>(wanted));
}

size_t ImportancePass::pdf_bytes(Half half) const {
  const gpu::Emitter& e = halves_.emitter(half);
  return pyramid_texels(e.width, e.height) * sizeof(float);
}

const Buffer& ImportancePass::pdf(Half half) const {
  return stage_.memory.pdf[static_cast<size_t>(half)].get(
      stage_.device, fmt::format("pdf.{}", half_name(half)), pdf_bytes(half));
}

std::vector<float> ImportancePass::read(Half half) const {
  return pdf(half).download<float>(halves_.texels(half));
}

unsigned ImportancePass::record(Recorder& r, glm::uvec2 shift, CarriedLights* carried) {
  drawn_from_own_ = true;
  if (!lights_) {
    r.pass({PassStage::importance, Half::rsm, ""}, [&] { draw_reflectance(r, Half::rsm); });
    return 0;
  }
  // 1. The eye's PDF on the G-buffer: reflectance.
  r.pass({PassStage::importance, Half::gbuffer, ""}, [&] { draw_reflectance(r, Half::gbuffer); });
  // 2. Lights on the G-buffer.
  const unsigned dispatches = lights_->generate(r, &pdf(Half::gbuffer), shift, carried);
  // 3. What they are worth at every RSM texel.
  r.pass({PassStage::importance, Half::rsm, ""}, [&] { gather(r); });
  return dispatches;
}

unsigned ImportancePass::generate(Recorder& recorder, const KeptPdfs& pdfs, glm::uvec2 shift) {
  drawn_from_own_ = false;
  return lights_ ? lights_->generate(recorder, &pdfs.gbuffer, shift) : 0;
}

KeptPdfs ImportancePass::keep() const {
  const auto keep = [&](Half half, const char* name) {
    Buffer kept(stage_.device, name, pdf_bytes(half));
    kept.upload(std::span<const float>(pdf(half).download<float>(pdf_bytes(half) / sizeof(float))));
    return kept;
  };
  return {keep(Half::gbuffer, "kept pdf.gbuffer"), keep(Half::rsm, "kept pdf.rsm")};
}

void ImportancePass::draw_reflectance(Recorder& r, Half half) const {
  const Field f = halves_.field(half, nullptr);
  r.dispatch(stage_.kernels.get(frame_kernel("pdf_reflectance.comp"), permutation(effects_, half, half)),
             {f.maps, pdf(half)}, f.emitter, groups_for(f.emitter.width, 8), groups_for(f.emitter.height, 8));
  build_mips(r, half);
}

void ImportancePass::gather(Recorder& r) const {
  const Field f = halves_.field(Half::rsm, nullptr);
  const ShaderDefines norm = {{"IMPORTANCE_L2", norm_ == ImportanceNorm::l2 ? "1" : "0"}};
  const Kernel& kernel = stage_.kernels.get(frame_kernel("importance.comp"),
                                            merged(merged(light_defines(lights_->kind(), shading_), norm),
                                                   permutation(effects_, Half::rsm, Half::gbuffer)));
  for (const LightRange& range : light_ranges(lights_->count(), most_lights_of_a_dispatch)) {
    const struct {
      gpu::Emitter emitter;
      LightRange range;
    } push{f.emitter, range};
    if (range.first > 0) r.barrier();
    r.dispatch(kernel, {f.maps, lights_->buffer(), pdf(Half::rsm)}, push, groups_for(f.emitter.width, 8),
               groups_for(f.emitter.height, 32));
  }
  build_mips(r, Half::rsm);
}

void ImportancePass::build_mips(Recorder& r, Half half) const {
  const Kernel& mip = stage_.kernels.get(frame_kernel("pdf_mip.comp"));
  const uint32_t w = halves_.emitter(half).width, h = halves_.emitter(half).height;
  for (uint32_t level = 1; level <= pyramid_top(w, h); ++level) {
    const struct { uint32_t width, height, level; } push{w, h, level};
    r.barrier();
    r.dispatch(mip, {pdf(half)}, push, groups_for(groups_for(w, 1u << level), 8),
               groups_for(groups_for(h, 1u << level), 8));
  }
}

}  // namespace vsglbench
