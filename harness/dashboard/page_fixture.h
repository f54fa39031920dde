// Tests only: a report of three cases with pictures, and the page of it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "answer/made_report.h"
#include "base/file.h"
#include "dashboard/page.h"
#include "image/exr.h"
#include "report/synthetic_report.h"

namespace vsglbench {

class PageTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              fmt::format("vsglbench-page-{}-{}", info->name(), ::getpid());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // Of three cases: two of the front, and one that is worse in both.
  std::filesystem::path report_with_pictures(const std::string& name = "made") {
    MadeReport m(1, 0.01, 0.02);
    m.add({"box", "fis", {{"N", 64}, {"visibility", "none"}}, {{"shade", 1}}, 20});
    m.add({"box", "fis", {{"N", 256}, {"visibility", "none"}}, {{"shade", 4}}, 10});
    m.add({"box", "vpl", {{"N", 256}, {"visibility", "none"}}, {{"shade", 8}}, 40});
    // What the schema asks for beside that.
    made_ = synthetic_report();
    made_.aa.clear();
    made_.scenes[0].name = "box";
    made_.scenes[0].exposure = 2;
    made_.scenes[0].effects_priced.reset();
    for (CaseResult& c : m.report.cases) {
      const CaseResult whole = synthetic_case(c.id);
      c.generate = whole.generate;
      c.health = whole.health;
      c.stopping = whole.stopping;
      c.accuracy->quantiles = whole.accuracy->quantiles;
    }
    made_.cases = m.report.cases;
    const std::filesystem::path folder = folder_ / name;
    std::filesystem::create_directories(folder / "images");
    for (size_t i = 0; i < made_.cases.size(); ++i) {
      Image image(8, 4);
      for (size_t p = 0; p < image.pixels.size(); ++p) image.pixels[p] = glm::vec3(float(p), float(i), 0.1f);
      const std::string file = fmt::format("images/{}.exr", i);
      write_exr(folder / file, image);
      write_exr(folder / "images/reference.exr", image);
      made_.cases[i].images = {{"indirect", file}, {"reference", "images/reference.exr"}, {"error", file}};
    }
    return folder;
  }
  Dashboard dashboard(const std::filesystem::path& folder, const PictureOrder& pictures = {}) {
    write(folder);
    return make_dashboard({{folder}, {}, {}, pictures});
  }
  void write(const std::filesystem::path& folder) {
    std::ofstream(folder / "report.json") << to_json(made_).dump();
  }

  std::filesystem::path folder_;
  Report made_;
};

// Of base64.
inline std::string decoded(const std::string& text) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  uint32_t bits = 0;
  int have = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<uint32_t>(digits.find(c));
    have += 6;
    if (have >= 8) out += static_cast<char>(bits >> (have -= 8) & 255);
  }
  return out;
}

}  // namespace vsglbench
