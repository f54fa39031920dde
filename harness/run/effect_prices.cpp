#include "run/effect_prices.h"

#include <algorithm>
#include <memory>

#include "measure/statistics.h"
#include "measure/stopwatch.h"
#include "run/memory.h"

namespace vsglbench {
namespace {

// One variant of the frame.
class Variant {
 public:
  Variant(Stage& stage, const PricedFrame& priced, const EffectSet& effects, const PriceOptions& options)
      : options_(options), effects_(effects) {
    const Stopwatch watch;
    now("opening");
    FrameParameters parameters = priced.parameters;
    parameters.effects = effects;
    const auto exact = [this, trace = priced.exact](const std::vector<LightPoint>& lights) {
      return trace(*frame_, lights);
    };
    frame_ = std::make_unique<Frame>(stage, priced.method, priced.method_parameters, parameters, exact);
    if (options_.wall) options_.wall->compilation_s += watch.seconds();
  }

  // Compiles what the frame needs, and traces its rays, which are those of every later frame.
  void warm_up() {
    const double rays_before = options_.wall ? options_.wall->visibility_s : 0;
    const Stopwatch watch;
    const double device_s = 1e-3 * render("warm-up").span_ms;
    if (!options_.wall) return;
    const double rays_s = options_.wall->visibility_s - rays_before;
    options_.wall->compilation_s += std::max(0.0, watch.seconds() - device_s - rays_s);
  }
  void step() {
    const FrameTimes times = render("a frame");
    span_ms.push_back(times.span_ms);
    double method = 0;
    for (const PassTime& time : times.passes)
      if (time.pass.stage != PassStage::draw) method += time.ms;
    method_ms.push_back(method);
  }
  void forget_times() {
    span_ms.clear();
    method_ms.clear();
  }
  int64_t bytes() const { return static_cast<int64_t>(frame_->memory_bytes()); }

  std::vector<double> span_ms, method_ms;  // of every step

 private:
  void now(const char* action) const {
    if (options_.now) options_.now(fmt::format("{} with the effects {}", action, to_text(effects_)));
  }
  FrameTimes render(const char* action) {
    now(action);
    const FrameTimes times = frame_->render(0);
    if (options_.wall) options_.wall->device_s += 1e-3 * times.span_ms;
    return times;
  }

  const PriceOptions& options_;
  const EffectSet effects_;
  std::unique_ptr<Frame> frame_;
};

bool is_priced(Effect effect) { return effect < Effect::moving_objects; }

void price(const Variant& with, const Variant& without, EffectReport* effect) {
  std::vector<double> difference;
  for (size_t i = 0; i < with.span_ms.size(); ++i) difference.push_back(with.span_ms[i] - without.span_ms[i]);
  effect->ms = median(difference);
  effect->ms_ci95 = bootstrap_median_ci95(difference);
  effect->bytes = with.bytes() - without.bytes();
}

EffectSaving saving_of(const Variant& derived, const Variant& forced) {
  return {.derived_ms = summarize(derived.method_ms),
          .forced_ms = summarize(forced.method_ms),
          .derived_span_ms = summarize(derived.span_ms),
          .forced_span_ms = summarize(forced.span_ms),
          .derived_bytes = derived.bytes(),
          .forced_bytes = forced.bytes()};
}

// Frames of this size that a quarter of the memory has room for, which others of the host may need.
size_t frames_that_fit(const DeviceInfo& device, int64_t bytes) {
  const uint64_t room = std::min<uint64_t>(available_memory(), device.memory_bytes) / 4;
  return std::max<size_t>(1, room / static_cast<uint64_t>(std::max<int64_t>(bytes, 1)));
}

// The frame with one effect switched, or with all.
struct Switched {
  EffectSet effects;
  EffectReport* report;  // null: with all
};

}  // namespace

EffectSaving price_effects(Stage& stage, const PricedFrame& priced, const PriceOptions& options,
                           std::vector<EffectReport>* ledger) {
  const EffectSet own_effects = priced.parameters.effects;
  std::vector<EffectReport> rows = *ledger;
  std::vector<Switched> left = {{EffectSet::all(), nullptr}};
  for (EffectReport& report : rows) {
    const Effect effect = effect_named(report.name);
    if (!is_priced(effect)) continue;
    const EffectSet one = EffectSet::none().add(effect);
    left.push_back({own_effects.has(effect) ? own_effects - one : own_effects | one, &report});
  }
  Variant own(stage, priced, own_effects, options);
  own.warm_up();
  const size_t at_once =
      options.at_once > 0 ? options.at_once : frames_that_fit(stage.device.info(), own.bytes());
  EffectSaving saving;
  for (size_t first = 0; first < left.size(); first += at_once) {
    const size_t count = std::min(at_once, left.size() - first);
    // 1. These variants.
    std::vector<std::unique_ptr<Variant>> others;
    for (size_t i = first; i < first + count; ++i)
      others.push_back(std::make_unique<Variant>(stage, priced, left[i].effects, options));
    for (const auto& other : others) other->warm_up();
    // 2. Their times and the case's own, in turn.
    own.forget_times();
    for (uint32_t round = 0; round < options.rounds; ++round) {
      own.step();
      for (const auto& other : others) other->step();
    }
    // 3. Differences.
    for (size_t i = 0; i < count; ++i) {
      EffectReport* report = left[first + i].report;
      if (!report) {
        saving = saving_of(own, *others[i]);
        continue;
      }
      const bool had = own_effects.has(effect_named(report->name));
      price(had ? own : *others[i], had ? *others[i] : own, report);
    }
  }
  *ledger = std::move(rows);
  return saving;
}

EffectPricing pricing_of(const EffectSaving& saving) {
  return {.rounds = saving.derived_span_ms.samples.size(),
          .span_ms = saving.derived_span_ms.median,
          .span_ms_all = saving.forced_span_ms.median,
          .ratio = median_ratio(saving.forced_span_ms.samples, saving.derived_span_ms.samples),
          .bytes = saving.derived_bytes,
          .bytes_all = saving.forced_bytes};
}

}  // namespace vsglbench
