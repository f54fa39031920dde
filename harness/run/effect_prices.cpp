#include "run/effect_prices.h"

#include <memory>

#include "measure/statistics.h"

namespace vsglbench {
namespace {

// One variant of the frame: its spans and method times, a round each.
struct Variant {
  Variant(Stage& stage, const PricedFrame& priced, const EffectSet& effects) {
    FrameParameters parameters = priced.parameters;
    parameters.effects = effects;
    frame = std::make_unique<Frame>(stage, priced.method, priced.method_parameters, parameters, priced.exact);
  }
  void warm_up() { frame->render(0); }
  void step() {
    const FrameTimes times = frame->render(0);
    span_ms.push_back(times.span_ms);
    double method = 0;
    for (const PassTime& time : times.passes)
      if (time.pass.stage != PassStage::draw) method += time.ms;
    method_ms.push_back(method);
  }

  std::unique_ptr<Frame> frame;
  std::vector<double> span_ms, method_ms;
};

bool is_priced(Effect effect) { return effect < Effect::moving_objects; }

void price(const Variant& with, const Variant& without, EffectReport* effect) {
  std::vector<double> difference;
  for (size_t i = 0; i < with.span_ms.size(); ++i) difference.push_back(with.span_ms[i] - without.span_ms[i]);
  effect->ms = median(difference);
  effect->ms_ci95 = bootstrap_median_ci95(difference);
  effect->bytes = int64_t(with.frame->memory_bytes()) - int64_t(without.frame->memory_bytes());
}

}  // namespace

EffectSaving price_effects(Stage& stage, const PricedFrame& priced, uint32_t rounds,
                           std::vector<EffectReport>* ledger) {
  const EffectSet effects = priced.parameters.effects;
  // 1. The frame, the frame with all effects, and for each effect the frame with it switched.
  std::vector<Variant> variants;
  variants.emplace_back(stage, priced, effects);
  variants.emplace_back(stage, priced, EffectSet::all());
  std::vector<EffectReport*> switched;
  for (EffectReport& report : *ledger) {
    const Effect effect = effect_named(report.name);
    if (!is_priced(effect)) continue;
    switched.push_back(&report);
    const EffectSet one = EffectSet::none().add(effect);
    variants.emplace_back(stage, priced, effects.has(effect) ? effects - one : effects | one);
  }
  // 2. Their times, in turn.
  for (Variant& variant : variants) variant.warm_up();
  for (uint32_t round = 0; round < rounds; ++round)
    for (Variant& variant : variants) variant.step();
  // 3. Differences.
  for (size_t i = 0; i < switched.size(); ++i) {
    const Variant &own = variants[0], &other = variants[2 + i];
    const bool had = effects.has(effect_named(switched[i]->name));
    price(had ? own : other, had ? other : own, switched[i]);
  }
  return {.derived_ms = summarize(variants[0].method_ms),
          .forced_ms = summarize(variants[1].method_ms),
          .derived_span_ms = summarize(variants[0].span_ms),
          .forced_span_ms = summarize(variants[1].span_ms),
          .derived_bytes = int64_t(variants[0].frame->memory_bytes()),
          .forced_bytes = int64_t(variants[1].frame->memory_bytes())};
}

}  // namespace vsglbench
