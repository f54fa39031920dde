#include "report/ledger.h"

#include <gtest/gtest.h>

#include "report/synthetic_report.h"

using namespace vsglbench;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

SceneReport scene() {
  SceneReport s = synthetic_report().scenes.at(0);
  s.effects.push_back({"occlusion", "a wall stands between", true, {"shade"}, {}, {}, {}});
  return s;
}

}  // namespace

TEST(Ledger, SaysNeededOrSkippedThePriceAndWhy) {
  EXPECT_EQ(ledger_text(scene().effects),
            "normal_maps  skipped  +0.20 ms [0.10 … 0.30], +0.00 MiB  no lit or seen surface has one\n"
            "occlusion    needed                                      a wall stands between\n");
}

TEST(Ledger, InShortNamesWhatIsNeededAndWhatAllWouldCost) {
  SceneReport s = scene();
  EXPECT_EQ(short_ledger(s),
            "cornell calls for 1 of 2 effects: occlusion\n"
            "  cornell/mfis: 10.0 ms and 1.0 MiB; with all effects 21.0 ms and 3.0 MiB, 2.10 [2.00 … 2.20] "
            "times as long; 4 rounds, 1.5 s\n"
            "  normal_maps  skipped  +0.20 ms [0.10 … 0.30], +0.00 MiB\n");
  s.effects_priced.reset();
  EXPECT_EQ(short_ledger(s), "cornell calls for 1 of 2 effects: occlusion\n");
}

TEST(Ledger, OfAReportHasEveryScene) {
  Report r = synthetic_report();
  r.scenes.push_back(scene());
  r.scenes.back().name = "ring514";
  const std::string text = ledgers_of(r);
  EXPECT_TRUE(has(text, "cornell\nnormal_maps")) << text;
  EXPECT_TRUE(has(text, "ring514\nnormal_maps")) << text;
  EXPECT_TRUE(has(text, "2.10 [2.00 … 2.20] times as long")) << text;
  for (SceneReport& s : r.scenes) s.effects.clear();
  EXPECT_THROW(ledgers_of(r), Error);
}
