// What a scene calls for gives the image of all effects: on the committed scenes, and on random ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "run/effect_prices.h"
#include "run/random_scene.h"

using namespace vsglbench;

namespace {

// Committed scenes and their views; those whose geometry is downloaded where it is there.
std::vector<std::string> committed_scenes() {
  const char* assets = std::getenv("VSGLBENCH_ASSETS");
  std::vector<std::string> names;
  for (const SceneInfo& info : list_scenes({data_root() / "scenes", assets ? assets : ""})) {
    if (!info.asset_present) continue;
    for (const std::string& view : info.views) names.push_back(info.name + ":" + view);
  }
  return names;
}

Scene load(const std::string& name) {
  const char* assets = std::getenv("VSGLBENCH_ASSETS");
  return load_scene(name, {data_root() / "scenes", assets ? assets : ""});
}

}  // namespace

TEST(Effects, OfTheCommittedScenesGiveTheImageOfAll) {
  const auto names = committed_scenes();
  ASSERT_GE(names.size(), 5u);
  for (const std::string& name : names) {
    Laboratory lab(load(name));
    for (const char* method : {"mfis", "vpl", "kmeans2d-segmented", "two-vsgl"}) {
      if (method == std::string("mfis")) {
        FrameParameters p = kSmall;
        p.visibility = Visibility::exact;
        expect_equal(lab, method, p);
      } else {
        expect_equal(lab, method, kSmall);
      }
    }
  }
}

TEST(Effects, OfEveryMethodGiveTheImageOfAll) {
  Laboratory cornell("cornell");
  ASSERT_GE(all_methods().size(), 12u);
  for (const MethodInfo* method : all_methods()) {
    FrameParameters p = kSmall;
    p.rsm = 32;
    expect_equal(cornell, method->name, p);
  }
  FrameParameters p = kSmall;
  p.bias_reduction = 4;
  expect_equal(cornell, "mfis", p);
  p.shading = {{"shading", "vsgl14"}, {"lobe_filter", "off"}};
  expect_equal(cornell, "fis", p);
  // With the lights of `vpl`, which are the same to the bit, so are their shadow maps. A rounding in those of
  // `mfis` may move a light over the edge of its map's texel.
  p.visibility = Visibility::tism;
  p.shading.clear();
  EXPECT_EQ(with_and_without(cornell, "vpl", p).difference, 0);
  const Forced images = with_and_without(cornell, "mfis", p);
  EXPECT_LT(measure_errors(images.derived, images.all, cornell.mask).smape, 1);
}

// A Lambert room without textures: what the paper's full model has beside it is skipped, and nothing else.
TEST(Effects, OfCornellAreDiffuseLightAndOcclusion) {
  const Scene scene = load("cornell");
  const EffectSet wanted =
      EffectSet::none().add(Effect::diffuse_receivers).add(Effect::diffuse_emitters).add(Effect::occlusion);
  EXPECT_EQ(to_text(needed(decisions_of(scene))), to_text(wanted));
  for (const EffectDecision& d : decisions_of(scene)) EXPECT_FALSE(d.reason.empty()) << name(d.effect);
}

// The ring's metal has a Phong exponent, whatever is seen or lit beside it; in cornell nothing has.
TEST(Effects, PhongLobesAreCalledForWhereASurfaceHasAnExponent) {
  EXPECT_TRUE(needed(decisions_of(load("ring514"))).has(Effect::phong_lobes));
  EXPECT_TRUE(needed(decisions_of(load("colonnade"))).has(Effect::phong_lobes));
  EXPECT_FALSE(needed(decisions_of(load("cornell"))).has(Effect::phong_lobes));
}

TEST(Effects, AreNamedInOptions) {
  EXPECT_EQ(parse_effects(""), EffectSet::none());
  EXPECT_EQ(parse_effects("all"), EffectSet::all());
  for (const std::string& name : effect_names()) {
    if (effect_named(name) >= Effect::moving_objects) continue;
    EXPECT_EQ(to_text(parse_effects(name)), name);
  }
  EXPECT_EQ(to_text(parse_effects("occlusion,diffuse_emitters")), "diffuse_emitters,occlusion");
  for (const char* bad : {"ocluson", "occlusion,", ",", "all,occlusion", "all,all", " occlusion",
                          "moving_light", "occlusion,moving_objects", "moving_camera"}) {
    EXPECT_THROW(parse_effects(bad), Error) << bad;
  }
}

// What is skipped is black, and not what its kernels would show with a lobe that nobody asked for.
TEST(Effects, WithoutBothLobesOfAHalfTheImageIsBlack) {
  Laboratory cornell("cornell");
  const EffectSet seen = EffectSet::none().add(Effect::diffuse_receivers).add(Effect::glossy_receivers);
  const EffectSet lit = EffectSet::none().add(Effect::diffuse_emitters).add(Effect::glossy_emitters);
  const auto expect_black = [&](const std::string& method, const FrameParameters& p) {
    for (const EffectSet& skipped : {seen, lit, seen | lit, EffectSet::all()}) {
      FrameParameters without = p;
      without.effects = EffectSet::all() - skipped;
      const Image image = cornell.render(method, Json::object(), without);
      EXPECT_EQ(std::ranges::count(image.pixels, glm::vec3(0)), std::ssize(image.pixels))
          << method << " without " << to_text(skipped);
    }
  };
  FrameParameters p = kSmall;
  p.rsm = 32;
  for (const MethodInfo* method : all_methods()) expect_black(method->name, p);
  p.visibility = Visibility::tism;
  expect_black("mfis", p);
  p.visibility = Visibility::none;
  p.shading = {{"shading", "vsgl14"}};
  expect_black("fis", p);
}

TEST(Effects, OfRandomScenesGiveTheImageOfAll) { expect_random_scenes_equal(24, false); }

// However many frames are held at a time.
TEST(Effects, ArePricedOneByOneAsAllAtOnce) {
  Laboratory lab("cornell");
  SceneEffects effects(lab.scene);
  const MethodInfo& method = load_method("vpl", Laboratory::device().info());
  PricedFrame frame{method, resolve_parameters(method, Json::object()), kSmall, {}};
  frame.parameters.effects = effects.of(frame.parameters);
  const std::vector<EffectReport> unpriced =
      ledger(effects.decisions(frame.parameters.width, frame.parameters.height));
  std::vector<EffectReport> by_one = unpriced, at_once = unpriced;
  std::vector<std::string> actions;
  const auto keep = [&](const std::string& action) { actions.push_back(action); };
  const EffectSaving one = price_effects(lab.stage, frame, {.rounds = 1, .at_once = 1, .now = keep}, &by_one);
  const auto opened = [](const std::string& action) { return action.starts_with("opening"); };
  EXPECT_EQ(std::ranges::count_if(actions, opened), 13);  // its own, all, and eleven switched
  for (size_t i = 0; i + 1 < actions.size(); ++i) EXPECT_FALSE(opened(actions[i]) && opened(actions[i + 1]));
  const EffectSaving all = price_effects(lab.stage, frame, {.rounds = 1, .at_once = 100}, &at_once);
  EXPECT_EQ(one.derived_bytes, all.derived_bytes);
  EXPECT_EQ(one.forced_bytes, all.forced_bytes);
  for (size_t i = 0; i < unpriced.size(); ++i) {
    EXPECT_EQ(by_one[i].bytes, at_once[i].bytes) << by_one[i].name;
    EXPECT_EQ(by_one[i].ms.has_value(), !by_one[i].name.starts_with("moving_"));
  }
}

// --- scenes on which a careless rule skips what is needed ---
