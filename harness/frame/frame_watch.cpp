#include "frame/frame_watch.h"

#include <algorithm>
#include <map>

#include "method/filtered_sampling.h"

namespace vsglbench {
namespace {

std::string unwritten(const HalfLights* lights) {
  if (!lights) return "";
  const std::vector<size_t> words = record_words(lights->kind(), lights->lobes());
  std::vector<size_t> unused;  // among the record's own words
  for (size_t i = 0; i < words.size(); ++i)
    if (std::ranges::count(info_of(lights->kind()).unused, words[i]) > 0) unused.push_back(i);
  const Unwritten found = find_unwritten(lights->buffer().download<uint32_t>(lights->count() * words.size()),
                                         words.size(), unused);
  const PassId pass{PassStage::generate, lights->half(), ""};
  if (found.records == 0) return "";
  if (found.records < lights->count())
    return fmt::format("{} of {} lights of {} were not written, the first is light {}", found.records,
                       lights->count(), pass, found.first);
  return fmt::format("none of the {} lights of {} was written", lights->count(), pass);
}

// Both halves' methods, the same one twice where it makes the importance itself.
std::vector<const LightGenerator*> generators_of(const FrameParts& parts) {
  std::vector<const LightGenerator*> out = {&parts.generator};
  if (const HalfLights* lights = parts.importance_lights()) out.push_back(&lights->generator());
  return out;
}

// The half that a pass works on.
std::optional<Half> half_of(const PassId& pass) {
  const bool shades = pass.stage == PassStage::shade && (pass.step.empty() || pass.step == "join");
  return shades || pass.stage == PassStage::direct ? Half::gbuffer : pass.half;
}

FrameOutputs::NamedBuffer named(const FrameParts& parts, const PassId& pass, const Buffer& buffer) {
  const auto is = [&](const Buffer& b) { return &b == &buffer; };
  const bool weighs = pass.stage == PassStage::importance && parts.importance;
  if (weighs && pass.half && is(parts.importance->pdf(*pass.half)))
    return {fmt::format("pdf.{}", half_name(*pass.half)), parts.importance->pdf_bytes(*pass.half)};
  const bool generates = pass.stage == PassStage::generate && pass.half;
  if (const HalfLights* lights = generates ? parts.lights_on(*pass.half) : nullptr) {
    if (is(lights->buffer())) return {fmt::format("lights.{}", half_name(*pass.half)), lights->bytes(), true};
    for (const auto& [name, scratch] : lights->generator().context().scratch_buffers()) {
      if (is(*scratch.buffer)) return {name, scratch.bytes};
    }
  }
  if (is(parts.shade.indirect())) return {"indirect", parts.halves.texels(Half::gbuffer) * sizeof(glm::vec4)};
  if (is(parts.shade.shaded())) return {"shares", parts.halves.texels(Half::gbuffer) * sizeof(glm::vec4)};
  return {"", buffer.size()};
}

FrameOutputs::HalfSize size_of(const FrameParts& parts, const PassId& pass) {
  const std::optional<Half> half = half_of(pass);
  if (!half) return {};
  const DeferredTargets& targets = parts.halves.targets(*half);
  const HalfLights* lights = parts.lights_on(*half);
  return {{targets.width, targets.height}, lights ? lights->count() : 0};
}

}  // namespace

// What a kernel of the method can reach: both halves' lights, the method's own scratch memory and the PDFs.
void FrameWatch::arm(const CarriedLights* carried) {
  if (parts_.importance_lights()) arm_half(Half::gbuffer);
  arm_half(Half::rsm);
  arm_scratch();
  for (const Half half : {Half::gbuffer, Half::rsm}) {
    const Buffer* state = carried ? carried->buffer(half) : nullptr;
    if (state) memory_.arm(fmt::format("carried.{}", half_name(half)), *state, state->size(), false);
  }
}

void FrameWatch::arm_half(Half half) {
  const HalfLights& lights = *parts_.lights_on(half);
  memory_.arm(fmt::format("lights.{}", half_name(half)), lights.buffer(), lights.bytes(), true);
  if (!parts_.importance) return;
  const Buffer& pdf = parts_.importance->pdf(half);
  memory_.arm(fmt::format("pdf.{}", half_name(half)), pdf, pdf.size(), false);
}

// To the end of what the pool gave, which may be more than was asked for: a method may clear all of it.
void FrameWatch::arm_scratch() {
  std::map<std::string, const Buffer*> all;
  for (const LightGenerator* generator : generators_of(parts_)) {
    for (const auto& [name, scratch] : generator->context().scratch_buffers()) all[name] = scratch.buffer;
  }
  for (const auto& [name, buffer] : all) memory_.arm(name, *buffer, buffer->size(), true);
}

void FrameWatch::look() {
  const std::string overrun = memory_.overrun();
  std::string fault = unwritten(parts_.importance_lights());
  if (fault.empty()) fault = unwritten(&parts_.lights);
  if (!overrun.empty()) fault += fmt::format("{}{} was written", fault.empty() ? "" : ", and ", overrun);
  if (fault_.empty()) fault_ = fault;
}

FrameOutputs outputs_of(const FrameParts& parts) {
  FrameOutputs out;
  out.buffer = [&](const PassId& pass, const Buffer& buffer) { return named(parts, pass, buffer); };
  out.half = [&](const PassId& pass) { return size_of(parts, pass); };
  out.targets = [&](const PassId& pass) -> const DeferredTargets* {
    return pass.stage == PassStage::draw && pass.half ? &parts.halves.targets(*pass.half) : nullptr;
  };
  return out;
}

}  // namespace vsglbench
