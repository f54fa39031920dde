#include "run/code_size.h"

#include <gtest/gtest.h>

#include "base/file.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

TEST(CodeSize, CountsWhatIsNeitherBlankNorComment) {
  EXPECT_EQ(count_lines(""), 0u);
  EXPECT_EQ(count_lines("\n  \n\t\n"), 0u);
  EXPECT_EQ(count_lines("int a;"), 1u);
  EXPECT_EQ(count_lines("int a;  // one\n// none\n\n  int b; /* two */\n"), 2u);
  EXPECT_EQ(count_lines("/* a\n b\n c */ int d;\n/**/\n"), 1u);
  EXPECT_EQ(count_lines("const char* url = \"http://x\"; // one\n\"/*\"\nint b;\n"), 3u);
}

TEST(CodeSize, FollowsIncludesOnce) {
  const auto files =
      include_closure(data_root() / "methods" / "mfis" / "mfis.comp",
                      {data_root() / "harness" / "shaders", data_root() / "harness" / "method" / "shaders"});
  std::set<std::string> names;
  for (const auto& file : files) names.insert(file.filename());
  for (const char* name :
       {"mfis.comp", "filtered_sampling.glsl", "moments.glsl", "sg.glsl", "warp.glsl", "pyramid.glsl"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  EXPECT_FALSE(names.contains("brdf.glsl"));
}

TEST(CodeSize, CountsDispatchesAsTheyAreRecorded) {
  Device device;
  const CodeSize mfis = code_size(device, "mfis"), fis = code_size(device, "fis"),
                 all = code_size(device, "all-texels");
  EXPECT_EQ(all.kernels, 1u);
  EXPECT_EQ(all.rsm_dispatches, 1u);
  // Additional RSM, which has level 1 too; one for two further levels of the pyramid; sampling.
  EXPECT_EQ(mfis.kernels, 3u);
  EXPECT_EQ(mfis.rsm_dispatches, 1u + 4u + 1u);
  EXPECT_EQ(mfis.gbuffer_dispatches, 1u + 5u + 1u);
  EXPECT_EQ(mfis.published->lines, 232);
  // The same method but for how wide a kernel is [MFIS16 §5, Code size].
  EXPECT_LT(mfis.own_lines + mfis.shared_lines, fis.own_lines + fis.shared_lines + 20);
}

}  // namespace
}  // namespace vsglbench
