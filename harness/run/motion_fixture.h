// Tests only: a small scene in motion, and an experiment that measures its flicker.
#pragma once

#include "run/run_fixture.h"
#include "run/runner.h"

namespace vsglbench {

class MotionFixture : public RunFixture {
 protected:
  void SetUp() override {
    RunFixture::SetUp();
    config_["motion"] = Json::object();
    config_["reference"]["samples"] = 256;  // detail that is not lost in noise
  }
  // A ring that crosses a box for `frames` frames, or hangs there.
  Json ring_scene(uint32_t frames, bool moves = true) const {
    const double end = (frames - 1) / 4.0, to = moves ? 0.5 : -0.5;
    Json scene = {{"name", "ring"},
                  {"description", "a ring in a box"},
                  {"geometry", {{"builder", "cornell"}}},
                  {"animation", {{"frames", frames}, {"rate", 4}}},
                  {"default_view", "front"}};
    scene["objects"] =
        Json::array({{{"name", "ring"},
                      {"torus", {{"major", 0.3}, {"minor", 0.1}}},
                      {"interpolation", "linear"},
                      {"keys", Json::array({{{"time", 0}, {"translation", {-0.5, 1.0, 0.2}}},
                                            {{"time", end}, {"translation", {to, 1.0, 0.2}}}})}}});
    scene["views"]["front"] = {
        {"camera", {{"eye", {0.02, 1.01, 3}}, {"direction", {0, 0, -1}}, {"vfov", 52}}},
        {"light",
         {{"spot",
           {{"position", {0.35, 1.9, 0.45}},
            {"target", {-0.55, 0.3, -0.6}},
            {"fov", 75},
            {"intensity", 10}}}}}};
    return scene;
  }
  void use(const Json& scene) { config_["scenes"] = {write_scene("ring", scene, "")}; }
  RunOptions options() const {
    RunOptions o;
    o.config = write_config();
    o.out = out_;
    o.argv = {"vsglbench", "run"};
    return o;
  }
  std::vector<CaseResult> run() {
    EXPECT_EQ(run_config(options()).exit_code, 0);
    expect_sound(out_ / "report.json");
    return read_report(out_ / "report.json").cases;
  }
};

}  // namespace vsglbench
