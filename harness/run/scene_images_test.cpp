// What stands on a contact sheet.
#include "run/scene_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(Captions, OfOneCaseAreItsMethod) {
  const Captions captions = captions_of({case_of("vpl", "N=64,rsm=256")});
  EXPECT_THAT(captions.cases, ElementsAre("vpl"));
  EXPECT_EQ(captions.shared, "N=64 rsm=256");
}
