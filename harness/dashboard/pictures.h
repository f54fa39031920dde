// Pictures for the dashboard's image view, chosen within a size.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json.h"
#include "report/report.h"

namespace vsglbench {

enum class PictureMode { none, png, exr };
// Throws Error(usage) for another text.
PictureMode picture_mode(const std::string& text);

struct PictureOrder {
  PictureMode mode = PictureMode::exr;
  double max_mb = 25;              // of the page that pictures may take, in base64; 1 MB = 10⁶ bytes
  std::string metric = "smape";    // whose front's cases come as EXR
  std::vector<std::string> cases;  // globs of more cases that do
};

// reports/dashboard/src/data.ts, Image, and its bytes.
struct Picture {
  Json entry;
  std::string base64;
};

struct ChosenPictures {
  std::vector<Picture> list;
  size_t left_out = 0;             // for `max_mb`
  std::vector<std::string> notes;  // files that are missing or damaged
};

// Of the report in `folder`, which is number `report` of the page: first references, then the front's cases
// and those asked for as half floats, flicker's pictures, and all other cases as PNG, as long as `room_mb`
// lasts. Without images/, what a committed report keeps: SCENE-METHOD.flicker.png.
ChosenPictures choose_pictures(const Report& report, const std::filesystem::path& folder, size_t report_index,
                               const std::vector<int>& groups, const PictureOrder& order, double room_mb);

std::string base64(std::string_view bytes);

}  // namespace vsglbench
