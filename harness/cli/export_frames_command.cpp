#include <fmt/format.h>

#include <algorithm>

#include "base/printable.h"
#include "cli/command.h"
#include "report/case_names.h"
#include "run/frame_export.h"
#include "run/scene_images.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

struct ExportFramesCommand {
  fs::path report, out;
  std::string only = "*", display = "standard_fhd";
};

double exposure_of(const Report& report, const std::string& scene) {
  const auto found = std::ranges::find(report.scenes, scene, &SceneReport::name);
  return found == report.scenes.end() ? 1 : found->exposure;
}

std::vector<const CaseResult*> cases_with_frames(const Report& report, const std::string& glob) {
  std::vector<const CaseResult*> cases;
  for (const CaseResult& c : report.cases)
    if (matches_glob(c.id, glob) && has_frames(c)) cases.push_back(&c);
  return cases;
}

void write(const ExportFramesCommand& command) {
  const Report report = read_report_at(command.report);
  const fs::path folder = report_file(command.report).parent_path();
  const std::vector<const CaseResult*> cases = cases_with_frames(report, command.only);
  if (cases.empty())
    throw fail(ErrorKind::usage, "{}: no case with frames matches '{}'", command.report.string(),
               command.only);
  for (const CaseResult* c : cases) {
    const ExportedFrames done = export_frames(folder, *c, exposure_of(report, c->scene),
                                              command.out / file_name(c->id), command.display);
    fmt::print(
        "{}: {} frames at {} a second; PNG full scale {:.6g} W/m²/sr ({} pixels of the test above it, {} "
        "below 0), EXR in W/m²/sr\n{}\n",
        printable(c->id), done.frames, done.rate, done.peak, done.loss.above, done.loss.below,
        printable(done.command));
  }
}

}  // namespace

void add_export_frames_command(CLI::App& app) {
  auto options = std::make_shared<ExportFramesCommand>();
  CLI::App* command = app.add_subcommand(
      "export-frames", "frames of cases in motion and of their references, for a video metric to compare");
  command->footer(
      "Writes OUT/CASE/test and OUT/CASE/reference: 0000.png on, 16 bits, sRGB, one scale for both, and the "
      "same\nframes as EXR, in place of an earlier export's; prints the scale, and the command line of "
      "ColorVideoVDP that compares the two.\n"
      "Example: vsglbench export-frames reports/out/flicker --only '*/mfis/*' --out frames");
  command->add_option("report", options->report, "report.json, or its folder, of a config with `motion`")
      ->required();
  command->add_option("--only", options->only, "glob over case ids");
  command->add_option("--out", options->out, "folder")->required()->check([](const std::string& out) {
    return std::string(out.empty() ? "needs a folder" : "");
  });
  command->add_option("--display", options->display, "as cvvdp names it")->capture_default_str();
  command->callback([=] { write(*options); });
}

}  // namespace vsglbench
