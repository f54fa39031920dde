// `vsglbench view`: what one looks at while placing a camera. One sheet a scene: direct and indirect light,
// the RSM, the PDF that lights are drawn by, normals. No reference, no report.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "frame/stage.h"
#include "image/png.h"
#include "run/sweep.h"

namespace vsglbench {

struct ViewSheetOptions {
  std::filesystem::path assets;  // empty: $VSGLBENCH_ASSETS
  std::string device;            // as in select_device()
};

// What a scene is drawn with: the method of the indirect light and its frame.
struct ViewedCase {
  std::string scene;  // as load_scene() takes it
  std::string method = "mfis";
  Json method_parameters = Json::object();
  FrameParameters frame{.width = 480, .height = 270, .rsm = 256, .lights = 256, .importance_lights = 512};
};

// `now` is told of each step. Opens a device. Throws Error.
Bitmap view_sheet(const ViewedCase& viewed, const ViewSheetOptions& options,
                  const std::function<void(const std::string&)>& now);

// A config's scenes, each with the first of its cases that has whole frames.
std::vector<ViewedCase> viewed_cases(const std::vector<Case>& cases);

}  // namespace vsglbench
