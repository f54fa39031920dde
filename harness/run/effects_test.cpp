// What a scene calls for gives the image of all effects: on the committed scenes, and on scenes where a
// careless rule skips what is needed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "run/effect_prices.h"
#include "run/random_scene.h"
#include "run/visibility_tracer.h"
#include "scene/animation.h"

using namespace vsglbench;

namespace {

constexpr double kEqual = 1e-5;  // relative, per pixel

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

void expect_equal(Laboratory& lab, const std::string& method, const FrameParameters& p,
                  const Json& own = Json::object()) {
  const Forced images = with_and_without(lab, method, p, own);
  std::printf("%s %s: %.2g\n", lab.scene.name.c_str(), method.c_str(), images.difference);
  EXPECT_LT(images.difference, kEqual) << lab.scene.name << ", " << method;
  const Health health = check_health(images.derived);
  EXPECT_TRUE(health.finite());
}

const FrameParameters kSmall{.rsm = 64, .lights = 64, .visibility = Visibility::none};

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
  EXPECT_EQ(std::ranges::count_if(actions, opened), 12);  // its own, all, and ten switched
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

namespace {

Material glossy(float roughness = 0.2f) {
  Material m;
  m.name = "glossy";
  m.base_color = glm::vec4(0.4f, 0.3f, 0.2f, 1);
  m.roughness = roughness;
  return m;
}

// A floor of 4 m and a back wall, a spot from above and a camera in front.
SceneMaker open_room(uint32_t* white) {
  SceneMaker maker;
  *white = maker.lambert();
  maker.quad(*white, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
  maker.quad(*white, {-2, 0, -2}, {4, 0, 0}, {0, 3, 0});
  maker.spot({0, 2.5f, 0.5f}, {0, 0, -0.5f}, 50);
  maker.camera({0, 1.2f, 4}, {0, 0.8f, 0}, 45);
  return maker;
}

void expect_called_for(Laboratory& lab, Effect effect) {
  EXPECT_TRUE(needs(lab.scene, effect)) << name(effect);
  FrameParameters p = kSmall;
  p.visibility = Visibility::exact;
  expect_equal(lab, "mfis", p);
  expect_equal(lab, "vpl", p);
  // Without it the image of all texels is another one: the scene is worth its name.
  p.rsm = 32;
  const Json exact = {{"shading", "exact"}};
  const Image with = lab.render("all-texels", exact, p);
  p.effects = p.effects - EffectSet::none().add(effect);
  EXPECT_GT(relative_difference(lab.render("all-texels", exact, p), with, black_of(lab.scene)), 10 * kEqual)
      << name(effect);
}

}  // namespace

// All corners of the mirror lie outside of the cone; one of its edges passes through a corner of it.
TEST(EffectsAdversary, AGlossyEmitterInAGrazingCornerOfTheCone) {
  uint32_t white = 0;
  SceneMaker maker = open_room(&white);
  const uint32_t mirror = maker.material(glossy());
  // The spot lights the floor up to a corner at (-1.06, 0, 0.64); the strip cuts 10 cm of it off.
  maker.quad(mirror, {-1.5, 0.001, 0.1}, {0.9, 0, 0.9}, {0, 0.1, 0});
  Laboratory lab(maker.finish());
  bool corner_inside = false;
  const View light = light_view(lab.scene.light);
  for (const Batch& batch : lab.scene.batches) {
    if (batch.material != mirror) continue;
    for (uint32_t t = batch.first_triangle; t < batch.first_triangle + batch.triangle_count; ++t)
      for (int k = 0; k < 3; ++k)
        corner_inside |= light.project(lab.scene.positions[lab.scene.triangles[t][k]]).has_value();
  }
  EXPECT_FALSE(corner_inside) << "the scene no longer shows what it is for";
  expect_called_for(lab, Effect::glossy_emitters);
}

TEST(EffectsAdversary, AnOccluderOutsideBothFrusta) {
  SceneMaker maker;
  const uint32_t white = maker.lambert();
  // The light shines on the left wall, the camera sees the right one; a screen stands between them.
  maker.quad(white, {-2, 0, 1}, {0, 0, -2}, {0, 2, 0});
  maker.quad(white, {2, 0, -1}, {0, 0, 2}, {0, 2, 0});
  maker.quad(white, {0, 0.5, 0.4}, {0, 0, -0.8}, {0, 1, 0});
  maker.spot({-1, 1, 0}, {-2, 1, 0}, 60);
  maker.camera({1, 1, 0}, {2, 1, 0}, 60);
  Laboratory lab(maker.finish());
  const View light = light_view(lab.scene.light), eye = camera_view(lab.scene.camera, 96, 54);
  for (uint32_t t = 4; t < 6; ++t)
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 p = lab.scene.positions[lab.scene.triangles[t][k]];
      EXPECT_FALSE(light.project(p) || eye.project(p)) << "the screen is in sight";
    }
  expect_called_for(lab, Effect::occlusion);
}

// Two walls that face each other: no triangle of theirs can stand between.
TEST(EffectsAdversary, NothingOccludesBetweenTwoWalls) {
  SceneMaker maker;
  const uint32_t white = maker.lambert();
  maker.quad(white, {-2, 0, 1}, {0, 0, -2}, {0, 2, 0});
  maker.quad(white, {2, 0, -1}, {0, 0, 2}, {0, 2, 0});
  maker.spot({-1, 1, 0}, {-2, 1, 0}, 60);
  maker.camera({1, 1, 0}, {2, 1, 0}, 60);
  Laboratory lab(maker.finish());
  EXPECT_FALSE(needs(lab.scene, Effect::occlusion));
  FrameParameters p = kSmall;
  p.visibility = Visibility::exact;
  expect_equal(lab, "mfis", p);
  expect_equal(lab, "vpl", p);
}

TEST(EffectsAdversary, ANormalMapThatIsFlatButForOneTexel) {
  uint32_t white = 0;
  SceneMaker maker = open_room(&white);
  std::vector<uint8_t> texels;
  for (int i = 0; i < 8 * 8; ++i) texels.insert(texels.end(), {128, 128, 255, 255});
  texels[4 * (8 * 3 + 4)] = 255;  // one leans
  Material m;
  m.name = "bumped";
  m.specular = 0;
  m.normal_texture = maker.texture(8, 8, false, texels);
  maker.quad(maker.material(m), {-0.8, 0.01, 0.3}, {1.6, 0, 0}, {0, 0, -1.6});
  Laboratory lab(maker.finish());
  expect_called_for(lab, Effect::normal_maps);
}

TEST(EffectsAdversary, RoughnessTexturedFromOneToNearlyNothing) {
  uint32_t white = 0;
  SceneMaker maker = open_room(&white);
  std::vector<uint8_t> texels;
  for (int i = 0; i < 16; ++i) texels.insert(texels.end(), {0, uint8_t(255 - 16 * i), 0, 255});
  Material m = glossy(1);
  m.metallic_roughness_texture = maker.texture(16, 1, false, texels);
  maker.quad(maker.material(m), {-0.8, 0.01, 0.3}, {1.6, 0, 0}, {0, 0, -1.6});
  Laboratory lab(maker.finish());
  EXPECT_TRUE(needs(lab.scene, Effect::glossy_emitters));
  EXPECT_TRUE(needs(lab.scene, Effect::glossy_receivers));
  expect_called_for(lab, Effect::metallic_roughness_textures);
}

// F0 = mix(0.04, 0, m): nothing where it is all metal, something where a texture says that it is not.
TEST(EffectsAdversary, AMetalWithBlackBaseColour) {
  for (const bool textured : {false, true}) {
    uint32_t white = 0;
    SceneMaker maker = open_room(&white);
    Material m;
    m.name = "black metal";
    m.base_color = glm::vec4(0, 0, 0, 1);
    m.metallic = 1;
    m.roughness = 0.2f;
    if (textured)
      m.metallic_roughness_texture = maker.texture(2, 1, false, {0, 255, 255, 255, 0, 255, 254, 255});
    maker.quad(maker.material(m), {-0.8, 0.01, 0.3}, {1.6, 0, 0}, {0, 0, -1.6});
    Laboratory lab(maker.finish());
    EXPECT_EQ(needs(lab.scene, Effect::glossy_receivers), textured);
    EXPECT_EQ(needs(lab.scene, Effect::glossy_emitters), textured);
    FrameParameters p = kSmall;
    p.visibility = Visibility::exact;
    expect_equal(lab, "mfis", p);
    expect_equal(lab, "vpl", p);
  }
}

TEST(EffectsAdversary, AnAlphaMaskWhoseOnlyHoleIsOneTexel) {
  uint32_t white = 0;
  SceneMaker maker = open_room(&white);
  std::vector<uint8_t> texels(4 * 8 * 8, 255);
  texels[4 * (8 * 4 + 4) + 3] = 0;
  Material m;
  m.name = "masked";
  m.specular = 0;
  m.alpha_cutoff = 0.5f;
  m.base_color_texture = maker.texture(8, 8, true, texels);
  maker.quad(maker.material(m), {-0.8, 0.6, 0.3}, {1.6, 0, 0}, {0, 0, -1.6});
  Laboratory lab(maker.finish());
  expect_called_for(lab, Effect::alpha_masks);
}

// Of two cases of a scene, one leaves the masks out: each one's shadow rays start from the surfaces that it
// sees.
TEST(EffectsAdversary, RaysStartFromWhatTheirFrameSees) {
  uint32_t white = 0;
  SceneMaker maker = open_room(&white);
  std::vector<uint8_t> texels(4 * 8 * 8, 255);
  for (size_t i = 0; i < texels.size() / 2; i += 4) texels[i + 3] = 0;
  Material m;
  m.name = "masked";
  m.alpha_cutoff = 0.5f;
  m.base_color_texture = maker.texture(8, 8, true, texels);
  maker.quad(maker.material(m), {-0.8, 0.6, 0.3}, {1.6, 0, 0}, {0, 0, -1.6});
  Laboratory lab(maker.finish());
  WallTime wall;
  VisibilityTracer shared(lab.tracer, &wall);
  std::vector<std::vector<uint32_t>> bits;
  const EffectSet masks = EffectSet::none().add(Effect::alpha_masks);
  for (const EffectSet& effects : {EffectSet::all(), EffectSet::all() - masks}) {
    FrameParameters p{.width = 64, .height = 36, .rsm = 32, .lights = 8, .visibility = Visibility::exact};
    p.effects = effects;
    Frame* self = nullptr;
    const MethodInfo& vpl = load_method("vpl", lab.device().info());
    Frame frame(lab.stage, vpl, resolve_parameters(vpl, Json::object()), p,
                [&](const std::vector<LightPoint>& lights) {
                  const auto found = shared.trace(*self, lights);
                  EXPECT_TRUE(found == VisibilityTracer(lab.tracer, &wall).trace(*self, lights));
                  bits.push_back(found);
                  return found;
                });
    self = &frame;
    frame.render(0);
  }
  ASSERT_EQ(bits.size(), 2u);
  EXPECT_FALSE(bits[0] == bits[1]) << "the mask hides nothing";
}

// Only metal is lit: the lights have no diffuse lobe.
TEST(EffectsAdversary, OnlyMetalIsLit) {
  SceneMaker maker;
  const uint32_t white = maker.lambert();
  Material m = glossy(0.3f);
  m.metallic = 1;
  const uint32_t metal = maker.material(m);
  maker.quad(metal, {-2, 0, 1}, {0, 0, -2}, {0, 2, 0});
  maker.quad(white, {2, 0, -1}, {0, 0, 2}, {0, 2, 0});
  maker.spot({-1, 1, 0}, {-2, 1, 0}, 60);
  maker.camera({1, 1, 0}, {2, 1, 0}, 60);
  Laboratory lab(maker.finish());
  EXPECT_FALSE(needs(lab.scene, Effect::diffuse_emitters));
  EXPECT_TRUE(needs(lab.scene, Effect::glossy_emitters));
  EXPECT_FALSE(needs(lab.scene, Effect::glossy_receivers));
  ASSERT_GE(all_methods().size(), 12u);
  for (const MethodInfo* method : all_methods()) {
    FrameParameters p = kSmall;
    p.rsm = 32;
    expect_equal(lab, method->name, p);
  }
}

// One half has a specular lobe, the other none: a kernel that takes the one's lobes for the other's loses it.
TEST(EffectsAdversary, OnlyWhatIsSeenOrOnlyWhatIsLitIsGlossy) {
  for (const bool seen : {true, false}) {
    SceneMaker maker;
    const uint32_t white = maker.lambert(), shiny = maker.material(glossy(0.3f));
    maker.quad(seen ? white : shiny, {-2, 0, 1}, {0, 0, -2}, {0, 2, 0});
    maker.quad(seen ? shiny : white, {2, 0, -1}, {0, 0, 2}, {0, 2, 0});
    maker.spot({-1, 1, 0}, {-2, 1, 0}, 60);
    maker.camera({1, 1, 0}, {2, 1, 0}, 60);
    Laboratory lab(maker.finish());
    EXPECT_EQ(needs(lab.scene, Effect::glossy_receivers), seen);
    EXPECT_EQ(needs(lab.scene, Effect::glossy_emitters), !seen);
    ASSERT_GE(all_methods().size(), 12u);
    for (const MethodInfo* method : all_methods()) {
      FrameParameters p = kSmall;
      p.rsm = 32;
      expect_equal(lab, method->name, p);
    }
  }
}

// A glossy plate that the camera sees in the last frame alone: what it calls for is there from the first on,
// and the last frame shows it.
TEST(EffectsAdversary, AnObjectThatEntersTheFrustumInTheLastFrame) {
  uint32_t white = 0;
  SceneMaker maker = open_room(&white);
  const uint32_t plate = maker.material(glossy());
  Scene scene = maker.finish();
  scene.animation.frames = 4;
  scene.animation.rate = 1;
  MovingNode node;
  node.name = "plate";
  node.translation.interpolation = Interpolation::step;
  node.translation.times = {0, 3};
  node.translation.values = {{0, 0.8, 9}, {0, 0.8, 0.5}};
  scene.animation.nodes.push_back(node);
  Mesh mesh;
  add_grid(&mesh, {-0.5, 0, 0}, {1, 0, 0}, {0, 0.8, -0.3}, 1, 1, 1);
  add_object(&scene, {.name = "plate"}, std::move(mesh), plate);
  measure_motion(&scene);
  EXPECT_TRUE(needs(scene, Effect::glossy_receivers));
  EXPECT_TRUE(needs(scene, Effect::moving_objects));
  EXPECT_FALSE(needs(scene, Effect::moving_light));
  const EffectSet effects = needed(decisions_of(scene));
  set_frame(&scene, 3);
  Laboratory lab(scene);
  FrameParameters p = kSmall;
  p.effects = effects;
  const Image derived = lab.render("mfis", Json::object(), p);
  p.effects = EffectSet::all();
  EXPECT_LT(relative_difference(derived, lab.render("mfis", Json::object(), p), black_of(scene)), kEqual);
  // The still scenes of its first frames would not have called for it.
  Scene still = scene;
  set_frame(&still, 0);
  still.animation.frames = 0;
  EXPECT_FALSE(needs(still, Effect::glossy_receivers));
}
