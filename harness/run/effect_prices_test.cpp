// What skipping effects saves, as ratios within one run.
#include <gtest/gtest.h>

#include "measure/verdict.h"
#include "run/effect_fixture.h"
#include "run/effect_prices.h"

using namespace vsglbench;

namespace {

// `rows`: the scene's ledger, priced; null: what all effects cost, and no more.
EffectSaving saving_of(const std::string& scene, uint32_t rounds, std::vector<EffectReport>* rows) {
  Laboratory lab(scene);
  SceneEffects effects(lab.scene);
  const MethodInfo& method = load_method("mfis", Laboratory::device().info());
  PricedFrame frame{method,
                    resolve_parameters(method, Json::object()),
                    {.width = 320,
                     .height = 184,
                     .rsm = 128,
                     .lights = 256,
                     .importance_lights = 512,
                     .visibility = Visibility::none},
                    {}};
  std::vector<EffectReport> none;
  if (rows) *rows = ledger(effects.decisions(frame.parameters.width, frame.parameters.height));
  frame.parameters.effects = effects.of(frame.parameters);
  return price_effects(lab.stage, frame, {.rounds = rounds}, rows ? rows : &none);
}

}  // namespace

// A Lambert room pays for no specular lobe: on a GPU half the time of generate, importance and shade; on a
// CPU, where reading a light costs as much as its arithmetic, two thirds of the frame's.
TEST(EffectPrices, CornellIsTwiceAsFastAsWithAllEffects) {
  std::vector<EffectReport> rows;
  const EffectSaving saving = saving_of("cornell", 8, &rows);
  const double method = saving.forced_ms.median / saving.derived_ms.median;
  const double frame = saving.forced_span_ms.median / saving.derived_span_ms.median;
  std::printf("cornell, all effects over those it calls for: method %.2f, frame %.2f, bytes %.2f\n", method,
              frame, double(saving.forced_bytes) / double(saving.derived_bytes));
  if (Laboratory::device().is_cpu()) {
    EXPECT_GE(frame, 1.5);
  } else {
    EXPECT_GE(method, 2);
  }
  EXPECT_LT(saving.derived_bytes, saving.forced_bytes);
  for (const EffectReport& row : rows) {
    if (row.name.starts_with("moving_")) continue;
    ASSERT_TRUE(row.ms && row.ms_ci95 && row.bytes) << row.name;
    std::printf("%s %.2f ms [%.2f, %.2f], %lld bytes\n", row.name.c_str(), *row.ms, row.ms_ci95->lo,
                row.ms_ci95->hi, static_cast<long long>(*row.bytes));
    EXPECT_GE(*row.bytes, 0) << row.name;
  }
}

// Where every effect is needed there is nothing to lose: the ledger makes no scene slower.
TEST(EffectPrices, NoSceneIsSlower) {
  for (const char* scene : {"cornell-glossy", "ring514", "colonnade"}) {
    const EffectSaving saving = saving_of(scene, 24, nullptr);
    const Ratio ratio = median_ratio(saving.derived_span_ms.samples, saving.forced_span_ms.samples);
    std::printf("%s, derived over forced: %.3f [%.3f, %.3f]\n", scene, ratio.value, ratio.ci95.lo,
                ratio.ci95.hi);
    EXPECT_LT(ratio.ci95.lo, 1.02) << scene;
  }
}
