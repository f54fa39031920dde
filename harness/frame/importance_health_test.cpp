// An importance that is no number is found, though no light is drawn from it.
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/file.h"
#include "frame/frame.h"
#include "method/light_kernel.h"
#include "scene/scene_file.h"

using namespace vsglbench;

// Lights that are finite, in whose light every texel of the RSM is worth a NaN or an Inf: no light is drawn
// from such a PDF, and the image is black and finite.
TEST(ImportanceHealth, AnImportanceThatIsNoNumberIsNamedByPassAndTexel) {
  Device device;
  const Scene scene = load_scene("cornell", {data_root() / "scenes", {}});
  KernelLibrary kernels(device);
  Stage stage(device, kernels, scene);
  MethodInfo info{.create = [](MethodContext& context, const Json&) {
    return make_light_kernel(context, "nan_importance.comp", LightKind::vsgl);
  }};
  info.name = "nan-importance";
  info.folder = data_root() / "harness" / "cli" / "bad_plugins";
  Frame frame(stage, info, Json::object(),
              {.width = 40,
               .height = 30,
               .rsm = 32,
               .lights = 24,
               .importance_lights = 32,
               .visibility = Visibility::none,
               .check_passes = true},
              nullptr);
  frame.render(0);
  ASSERT_TRUE(frame.bad_output());
  EXPECT_EQ(frame.bad_output()->pass.name(), "importance.rsm");
  EXPECT_EQ(frame.bad_output()->buffer, "pdf.rsm");
  EXPECT_TRUE(frame.bad_output()->texel);
  const auto bad = frame.results().bad_values();
  ASSERT_TRUE(bad);
  EXPECT_FALSE(bad->are_lights);
  EXPECT_EQ(bad->pass.name(), "importance.rsm");
  EXPECT_GT(bad->nan, 0u);
  EXPECT_EQ(bad->texel, *frame.bad_output()->texel);
  EXPECT_EQ(frame.results().first_bad_pass(), bad->pass);
  EXPECT_THROW(frame.prepare(0), Error);
}
