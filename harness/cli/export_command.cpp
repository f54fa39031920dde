#include <fmt/format.h>

#include "base/file.h"
#include "cli/command.h"
#include "image/metrics.h"
#include "reference/cache.h"
#include "report/export.h"
#include "report/image_labels.h"
#include "run/memory.h"
#include "run/runner.h"
#include "scene/gltf_export.h"
#include "scene/scene_file.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

struct ExportCommand {
  std::string what, format;
  fs::path out, folder, assets;
  ReferenceParameters reference{.width = 480, .height = 270, .samples = 512};
  bool no_reference = false;
};

void write_report(const ExportCommand& command) {
  const std::string text = export_report(read_report_at(command.what), command.format).dump(2) + "\n";
  command.out.empty() ? fmt::print("{}", text) : write_text(command.out, text);
}

// With the ground truth that a stranger's picture is compared with.
void write_scene(const ExportCommand& command) {
  const Scene scene = load_scene(command.what, {data_root() / "scenes", assets_directory(command.assets)});
  export_scene(scene, command.folder, command.reference.width, command.reference.height);
  if (!command.no_reference) {
    require_reference_memory(command.reference.width, command.reference.height);
    bool cached = false;
    const ReferenceResult reference = load_or_compute(scene, command.reference, &cached);
    Labels labels = radiance_image_labels("indirect radiance, ray-traced reference", scene.name, scene.hash);
    labels.insert({{"reference", reference.hash}, {"samples", fmt::format("{}", reference.samples)}});
    write_exr(command.folder / "reference.exr", reference.mean, reference.mask, labels);
    const float exposure = auto_exposure(reference.mean, reference.mask);
    labels.erase("A");
    labels["exposure"] = fmt::format("{}", exposure);
    write_png(command.folder / "reference.png", tone_map(reference.mean, exposure), labels);
  }
  fmt::print("{}\n", (command.folder / "README.md").string());
}

void write(const ExportCommand& command) {
  if (command.format.empty() == command.folder.empty())
    throw fail(ErrorKind::usage,
               "export takes --format for a report, or --to for a scene; see vsglbench export --help");
  command.folder.empty() ? write_report(command) : write_scene(command);
}

}  // namespace

void add_export_command(CLI::App& app) {
  auto options = std::make_shared<ExportCommand>();
  CLI::App* command = app.add_subcommand(
      "export", "a report in the formats of other dashboards, or a scene for other renderers");
  command->footer(
      "bencher           Bencher Metric Format: latency (ns, of the method's passes), frame-latency, smape, "
      "rmse, flip\n"
      "github-action     github-action-benchmark's customSmallerIsBetter: ms and % alone\n"
      "google-benchmark  as Google Benchmark's JSON: real_time is the median of the method's passes, errors "
      "are counters\n"
      "A scene becomes a folder with glTF, a script for Blender's Cycles, the reference, and a README of "
      "units and "
      "conventions.\n"
      "Examples: vsglbench export reports/quick-lavapipe --format bencher --out metrics.json; vsglbench "
      "export cornell "
      "--to /tmp/cornell");
  command
      ->add_option("what", options->what,
                   "report.json or its folder; with --to a scene, as `run --scene` takes it")
      ->required();
  command->add_option("--format", options->format,
                      fmt::format("of a report: {}", fmt::join(export_formats(), ", ")));
  command->add_option("--out", options->out, "file of a report (default: standard output)");
  command->add_option("--to", options->folder, "folder of a scene");
  command->add_option("--width", options->reference.width, "of a scene's reference, pixels")
      ->check(CLI::Range(1, 16384))
      ->capture_default_str();
  command->add_option("--height", options->reference.height, "pixels")
      ->check(CLI::Range(1, 16384))
      ->capture_default_str();
  command->add_option("--samples", options->reference.samples, "a pixel, of the reference")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  command->add_flag("--no-reference", options->no_reference, "leave the reference out");
  command->add_option("--assets", options->assets, "folder of downloaded scenes (default $VSGLBENCH_ASSETS)");
  command->callback([=] { write(*options); });
}

}  // namespace vsglbench
