#include "papers/sheet_rows.h"

#include <algorithm>

#include "base/error.h"
#include "image/theme.h"
#include "report/case_names.h"
#include "run/case_run.h"
#include "run/scene_images.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

using Problems = std::vector<std::string>;

std::string metrics_line(const CaseResult& c) {
  if (!c.accuracy) return "";
  const auto value = [](const MetricResult& m) { return m.heavy_tailed ? m.median : m.value; };
  const auto rmse = value(c.accuracy->rmse), smape = value(c.accuracy->smape);
  return rmse && smape ? fmt::format("SMAPE {:.3g} %  RMSE {:.3g}", *smape, *rmse) : "";
}

Bitmap empty(uint32_t width, uint32_t height) {
  Bitmap out(width, height);
  for (size_t i = 0; i < out.bytes.size(); ++i) out.bytes[i] = theme().paper[static_cast<int>(i % 3)];
  return out;
}

// One that can't be read costs its own tile: a low one that says so.
SheetTile tile_of(const fs::path& folder, const std::string& file, std::string caption, std::string detail,
                  const SheetPart& part, Problems* problems) {
  const auto failed = [&](ErrorKind, const std::string& message) {
    problems->push_back(fmt::format("{}: the picture {}; measure it anew with --force", part.run, message));
  };
  SheetTile tile{empty(4, 1), caption, "can't be read"};
  guarded([&] { tile = {read_png(folder / file), caption, std::move(detail)}; }, failed);
  return tile;
}

// A row of the cases that have the image; no tile where none has.
SheetRow row_of(const std::vector<CaseResult>& cases, const std::string& image, const Captions& captions,
                const fs::path& folder, const SheetPart& part, Problems* problems) {
  SheetRow row;
  const bool plain = image == "indirect";
  for (size_t i = 0; i < cases.size(); ++i) {
    const auto at = cases[i].images.find(image);
    if (at == cases[i].images.end()) continue;
    const std::string caption = captions.cases[i] + (plain ? "" : ": " + image);
    row.tiles.push_back(tile_of(folder, preview_of(at->second), caption, plain ? metrics_line(cases[i]) : "",
                                part, problems));
  }
  return row;
}

std::vector<SheetRow> rows_of_scene(const std::vector<CaseResult>& cases, const fs::path& folder,
                                    const SheetPart& part, Problems* problems) {
  const Captions captions = captions_of(cases);
  std::optional<SheetTile> reference;
  if (std::ranges::count(part.images, "reference") > 0)
    reference = tile_of(folder, preview_of(cases[0].images.at("reference")), "reference", "", part, problems);
  std::vector<SheetRow> out;
  for (const std::string& image : part.images) {
    if (image == "reference") continue;
    SheetRow row = row_of(cases, image, captions, folder, part, problems);
    if (row.tiles.empty()) continue;
    if (out.empty()) row.title = fmt::format("{}  {}", cases[0].scene, captions.shared);
    if (reference) {
      const Bitmap& shown = reference->picture;
      const SheetTile place = {empty(shown.width, shown.height), "", ""};  // keeps it free
      row.tiles.insert(row.tiles.begin(), out.empty() ? *reference : place);
    }
    out.push_back(std::move(row));
  }
  return out;
}

// What the part asks for, and no case of it that was measured has; why one was not stands elsewhere.
void tell_what_matches_nothing(const Report& report, const SheetPart& part, Problems* problems) {
  std::vector<CaseResult> meant;
  std::ranges::copy_if(report.cases, std::back_inserter(meant),
                       [&](const CaseResult& c) { return matches_glob(c.id, part.cases); });
  if (meant.empty()) problems->push_back(fmt::format("{}: no case matches '{}'", part.run, part.cases));
  std::erase_if(meant, [](const CaseResult& c) { return c.status != Status::ok; });
  if (meant.empty()) return;
  for (const std::string& image : part.images) {
    const auto has = [&](const CaseResult& c) { return c.images.contains(image); };
    if (std::ranges::none_of(meant, has))
      problems->push_back(
          fmt::format("{}: no case that matches '{}' has a picture '{}'", part.run, part.cases, image));
  }
}

// PNG files below the folder, in order of their names.
std::vector<std::string> pictures_in(const fs::path& folder) {
  std::vector<std::string> paths;
  std::error_code ec;
  for (fs::recursive_directory_iterator at(folder, ec), end; !ec && at != end; at.increment(ec)) {
    if (at->path().filename().string().starts_with('.'))
      continue;  // half written by a process that was killed
    if (at->path().extension() == ".png")
      paths.push_back(at->path().lexically_relative(folder).generic_string());
  }
  std::ranges::sort(paths);
  return paths;
}

}  // namespace

std::vector<SheetRow> rows_of(const Report& report, const fs::path& folder, const SheetPart& part,
                              Problems* problems) {
  tell_what_matches_nothing(report, part, problems);
  std::vector<std::string> scenes;
  for (const CaseResult& c : report.cases) {
    if (std::ranges::count(scenes, c.scene) == 0) scenes.push_back(c.scene);
  }
  std::vector<SheetRow> out;
  for (const std::string& scene : scenes) {
    std::vector<CaseResult> cases;
    std::ranges::copy_if(report.cases, std::back_inserter(cases), [&](const CaseResult& c) {
      return c.scene == scene && matches_glob(c.id, part.cases) && c.images.contains("reference");
    });
    if (cases.empty()) continue;
    for (SheetRow& row : rows_of_scene(cases, folder, part, problems)) out.push_back(std::move(row));
  }
  return out;
}

SheetRow files_of(const fs::path& folder, const SheetPart& part, Problems* problems) {
  const std::vector<std::string> paths = pictures_in(folder);
  for (const std::string& glob : part.files) {
    if (std::ranges::none_of(paths, [&](const std::string& path) { return matches_glob(path, glob); }))
      problems->push_back(fmt::format("{}: no picture matches '{}'", part.run, glob));
  }
  SheetRow row;
  for (const std::string& path : paths) {
    const auto matches = [&](const std::string& glob) { return matches_glob(path, glob); };
    if (std::ranges::any_of(part.files, matches))
      row.tiles.push_back(tile_of(folder, path, path.substr(0, path.size() - 4), "", part, problems));
  }
  return row;
}

}  // namespace vsglbench
