// Scenes where a careless rule skips what is needed.
#include <gtest/gtest.h>

#include <algorithm>

#include "run/effect_fixture.h"
#include "run/visibility_tracer.h"
#include "scene/animation.h"

using namespace vsglbench;

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
