// A published table beside what devices gave.
#include "papers/side_by_side.h"

#include <gtest/gtest.h>

#include "base/error.h"

using namespace vsglbench;

namespace {

MeasuredReport measured(const std::string& device, double scale) {
  MeasuredReport m{"reports/" + device + ".json", {}};
  m.report.device.name = device;
  m.report.created = "2024-05-01T12:00:00Z";
  m.report.git.commit = "0123456789abcdef";
  for (const auto& [method, ms] : {std::pair{"fis", 1.0}, std::pair{"kmeans2d", 8.0}}) {
    CaseResult c;
    c.id = std::string("box/") + method + "/N=1";
    c.scene = "box";
    c.method = method;
    c.passes.push_back({parse_pass_name("generate.rsm.sample"), summarize({scale * ms, scale * ms})});
    m.report.cases.push_back(c);
  }
  return m;
}

PublishedColumn column(const std::string& method, const std::string& ms) {
  return {method,
          "GTX 1",
          "*/" + method + "/*",
          "*",
          {{"Sample", ms, {"generate.rsm.sample"}, false}, {"Total", ms, {"generate.*"}, true}}};
}

Exhibit exhibit() {
  Exhibit e;
  e.name = "made";
  e.source = "[X Tab. 1]";
  e.title = "Times";
  e.table = {column("fis", "2.5"), column("kmeans2d", "20.0")};
  return e;
}

}  // namespace

TEST(SideBySide, EachDeviceStandsBesideWhatIsPublished) {
  EXPECT_EQ(side_by_side(exhibit(), "box", {measured("CPU 1", 100), measured("GPU 2", 0.5)}),
            "| | | GTX 1, published | CPU 1 | GPU 2 |\n"
            "| --- | --- | ---: | ---: | ---: |\n"
            "| fis | Sample | 2.5 | 100 | 0.5 |\n"
            "|  | Total | **2.5** / 1.00 | **100** / 1.00 | **0.5** / 1.00 |\n"
            "| kmeans2d | Sample | 20.0 | 800 | 4 |\n"
            "|  | Total | **20.0** / 8.00 | **800** / 8.00 | **4** / 8.00 |\n"
            "\n[X Tab. 1]: Times, ms; of totals also how many times the first; scene box: "
            "[CPU 1 of 2024-05-01, commit 0123456](reports/CPU 1.json), "
            "[GPU 2 of 2024-05-01, commit 0123456](reports/GPU 2.json).\n");
}

TEST(SideBySide, WhatCantStandThereIsRefused) {
  EXPECT_THROW(side_by_side(exhibit(), "ring", {measured("CPU", 1)}), Error);
  MeasuredReport half = measured("CPU", 1);
  half.report.cases.pop_back();
  EXPECT_THROW(side_by_side(exhibit(), "box", {half}), Error);
  EXPECT_THROW(published_table({"mfis16-tab1", "scene=box"}, "."), Error);
  EXPECT_THROW(published_table({"mfis16-tab9", "scene=box", "none.json"}, "."), Error);
}
