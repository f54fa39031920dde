// What dashboard refuses, on committed reports.
#include <filesystem>

#include "base/file.h"
#include "base/json.h"
#include "cli/cli_fixture.h"

namespace vsglbench {
namespace {

const std::string kReports = std::string(VSGLBENCH_SOURCE_DIR) + "/reports/";

TEST_F(CliTest, DashboardRefusesWhatItCanNotShow) {
  const std::string cut = kReports + "cut-lavapipe", out = (folder_ / "page.html").string();
  expect_refused(run({"dashboard"}), 2, "reports is required");
  expect_refused(run({"dashboard", "no-such-report", "--out", out}), 2, "no-such-report");
  expect_refused(run({"dashboard", cut, "--out", ""}), 2, "--out: is empty");
  expect_refused(run({"dashboard", cut, "--out", out, "--images", "jpg"}), 2, "there are none, png, exr");
  expect_refused(run({"dashboard", cut, "--out", out, "--metric", "smap"}), 2, "did you mean 'smape'");
  expect_refused(run({"dashboard", cut, "--out", out, "--max-mb", "-1"}), 2, "--max-mb -1: is below 0; name");
  expect_refused(run({"dashboard", cut, "--out", out, "--max-mb", "nan"}), 2,
                 "--max-mb: nan is no finite number");
  expect_refused(run({"dashboard", cut, "--out", folder_.string()}), 2, ": is a folder; name a file in it");
  const std::string report = cut + "/report.json";
  expect_refused(run({"dashboard", cut, "--out", out, "--papers", report}), 2, "no papers.json");
  expect_refused(run({"dashboard", cut, "--out", out, "--stability", report}), 2, "vsglbench.stability/1");
  expect_refused(run({"dashboard", cut, "--out", out, "--papers", ""}), 2, "--papers: is empty");
  const std::string cells = (folder_ / "cells.json").string();
  for (const char* text : {"5", "[null]", R"([{"case": "a"}])"}) {
    write_text(cells, std::string(
                          R"({"schema": "vsglbench.stability/1", "ok_error": 1, "bad_error": 2, "cells": )") +
                          text + "}");
    expect_refused(run({"dashboard", cut, "--out", out, "--stability", cells}), 2, "cells.json:1: ");
  }
  const std::string orphan = (folder_ / "report.json").string();
  Json json = Json::parse(read_text(report));
  json["cases"][0]["scene"] = "nowhere";
  write_text(orphan, json.dump());
  expect_refused(run({"dashboard", orphan, "--out", out}), 2,
                 "'nowhere', which is not in the report's scenes");
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace vsglbench
