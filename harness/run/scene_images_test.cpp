// What stands on a contact sheet.
#include "run/scene_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

using namespace vsglbench;
using testing::ElementsAre;

namespace {

CaseResult case_of(const std::string& method, const std::string& settings) {
  CaseResult c;
  c.scene = "cornell";
  c.method = method;
  c.id = "cornell/" + method + "/" + settings;
  return c;
}

}  // namespace

// What all cases share would push what tells them apart off the tile.
TEST(Captions, ShowWhatCasesDifferIn) {
  const Captions captions =
      captions_of({case_of("mfis", "N=64,rsm=256,vis=exact"), case_of("mfis", "N=256,rsm=256,vis=exact,K=2"),
                   case_of("all-texels", "rsm=256,vis=exact")});
  EXPECT_THAT(captions.cases, ElementsAre("mfis N=64", "mfis N=256 K=2", "all-texels"));
  EXPECT_EQ(captions.shared, "rsm=256 vis=exact");
}

TEST(FiguresOfACase, NameErrorsAndTime) {
  CaseResult c = case_of("mfis", "N=64");
  Errors e{24.84, 0.01551, 0.3, 0.5, -0.1993, 9, 21.02, 0.5, 0.1234, 0.5};
  c.accuracy = accuracy_over_seeds({{0, e}}, {});
  EXPECT_EQ(figures_of(c), "SMAPE 24.8 %   lit 21 %   RMSE 0.0155\nbias -19.9 %   FLIP 0.123");
  c.frame = frame_timing({2449, 2449}, {{{PassStage::draw, Half::gbuffer, ""}, summarize({9, 9})},
                                        {{PassStage::shade, std::nullopt, ""}, summarize({41.52, 41.52})}});
  EXPECT_THAT(figures_of(c), testing::EndsWith("FLIP 0.123   method 41.5 ms"));
  c.frame->method.reset();
  EXPECT_THAT(figures_of(c), testing::EndsWith("FLIP 0.123   frame 2449 ms"));
  e.bias.reset();
  c.accuracy = accuracy_over_seeds({{0, e}}, {});
  EXPECT_THAT(figures_of(c), testing::HasSubstr("bias undefined"));
  c.status = Status::failed;
  c.error = CaseError{ErrorKind::case_failed, "it crashed"};
  EXPECT_EQ(figures_of(c), "it crashed");
}

TEST(SheetOrder, IsByMethodThenLightsThenTheConfig) {
  std::vector<CaseResult> cases = {case_of("vpl", "N=1024"), case_of("mfis", "N=256"),
                                   case_of("mfis", "N=64,K=2"), case_of("mfis", "N=64,K=1"),
                                   case_of("all-texels", "")};
  const int lights[] = {1024, 256, 64, 64};
  for (size_t i = 0; i < 4; ++i) cases[i].parameters["N"] = lights[i];
  EXPECT_THAT(sheet_order(cases), ElementsAre(4, 2, 3, 1, 0));
}

TEST(Captions, OfOneCaseAreItsMethod) {
  const Captions captions = captions_of({case_of("vpl", "N=64,rsm=256")});
  EXPECT_THAT(captions.cases, ElementsAre("vpl"));
  EXPECT_EQ(captions.shared, "N=64 rsm=256");
}

// Whatever a scene is called, its pictures stay in the output folder.
TEST(FileName, IsOneHarmlessComponent) {
  EXPECT_EQ(file_name("cornell"), "cornell");
  EXPECT_EQ(file_name("colonnade:cut"), "colonnade@cut");
  EXPECT_EQ(file_name("N=256,rsm=256,vis=exact"), "N=256,rsm=256,vis=exact");
  std::set<std::string> seen;
  for (const std::string& name :
       {std::string(".."), std::string("."), std::string(""), std::string("../../etc/x.json"),
        std::string("/abs/scene.json"), std::string("_abs_scene.json"), std::string("a b"),
        std::string("a\nb"), std::string(1000, 'x'), std::string("\0", 1)}) {
    const std::string file = file_name(name);
    EXPECT_EQ(file.find_first_of("/\\ \n:"), std::string::npos) << file;
    EXPECT_EQ(file.find('\0'), std::string::npos);
    EXPECT_NE(file.front(), '.');
    EXPECT_LT(file.size(), 200u);
    EXPECT_TRUE(seen.insert(file).second) << file;
  }
}
