// Faults planted into the kernels flip a verdict each, which `reproduce --check` names.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "base/file.h"
#include "papers/flips.h"
#include "papers/reproduce.h"

using namespace vsglbench;
namespace fs = std::filesystem;

namespace {

struct Fault {
  std::string file, sound, planted;
};

// A copy of the kernels, configs and scenes, in which a fault may be planted; the programme reads it in place
// of the source tree.
class PlantedFault : public ::testing::Test {
 protected:
  PlantedFault() : folder_(fs::temp_directory_path() / fmt::format("vsglbench-planted-{}", ::getpid())) {
    for (const char* part : {"harness", "methods", "configs", "scenes"}) {
      fs::create_directories(folder_ / "root" / part);
      fs::copy(data_root() / part, folder_ / "root" / part, fs::copy_options::recursive);
    }
    ::setenv("VSGLBENCH_ROOT", (folder_ / "root").c_str(), 1);
  }
  ~PlantedFault() override {
    ::unsetenv("VSGLBENCH_ROOT");
    fs::remove_all(folder_);
  }

  Json make(const std::string& exhibit, const std::string& out) const {
    WorkOptions options;
    options.scale = kQuickScale;
    options.out = folder_ / out;
    options.argv = {"vsglbench", "reproduce"};
    options.assets = folder_;  // no scene that needs a download: the same everywhere
    PapersWork work(options);
    const Exhibit e = select_exhibits(load_exhibits(), {exhibit}).front();
    const Json made = reproduce_exhibit(e, load_claims(), &work, kQuickScale, folder_);
    return {{"exhibits", Json::array({made})}};
  }

  void expect_flip(const std::string& exhibit, const Fault& fault, const std::string& claim) const {
    const Json before = make(exhibit, "sound");
    const fs::path file = folder_ / "root" / fault.file;
    std::string text = read_text(file);
    const size_t at = text.find(fault.sound);
    ASSERT_NE(at, std::string::npos) << fault.file << " has changed";
    text.replace(at, fault.sound.size(), fault.planted);
    write_text(file, text);
    const Json after = make(exhibit, "planted");
    size_t lost = 0, named = 0;
    for (const Flip& flip : flips(before, after).changed) {
      fmt::print("{}{}\n", flip.lost ? "FLIPPED " : "changed ", flip_text(flip));
      lost += flip.lost;
      named += flip.lost && flip.before.claim == claim && flip.before.ruling == Ruling::holds;
    }
    EXPECT_GT(lost, 0u);
    EXPECT_GT(named, 0u) << "not of " << claim;
  }

 private:
  fs::path folder_;
};

TEST_F(PlantedFault, ExchangedAxesOfTheReceiversLobe) {
  expect_flip("vsgl15s-receiver",
              {"harness/shaders/receiver.glsl", "asg_product(local, sg.sharpness, r.eta_x, r.eta_y)",
               "asg_product(local, sg.sharpness, r.eta_y, r.eta_x)"},
              "anisotropic-receiver");
}

TEST_F(PlantedFault, ThePdfAtTheCentreInPlaceOfItsMean) {
  expect_flip("mfis16-fig5",
              {"harness/method/shaders/equal_probability.glsl",
               "footprint_area(level) * filtered_pdf(c, level)", "footprint_area(level) * c.p"},
              "kernels-hold-a-share");
}

TEST_F(PlantedFault, NoVarianceOfASingleTexel) {
  expect_flip("vsgl14-singularity",
              {"harness/shaders/field.glsl", "m.variance = t.footprint / 6.0;", "m.variance = 0.0;"},
              "vsgls-have-no-singularity");
}

}  // namespace
