#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/percent.h"
#include "base/printable.h"
#include "base/progress.h"
#include "cli/command.h"
#include "image/metrics.h"
#include "reference/cache.h"
#include "report/image_labels.h"
#include "run/memory.h"
#include "run/references.h"
#include "run/runner.h"
#include "run/scene_images.h"
#include "scene/scene_file.h"

namespace vsglbench {
namespace {

struct ReferenceOptions {
  std::string scene;
  std::filesystem::path out = ".", assets;
  ReferenceParameters parameters;
  bool no_occlusion = false;
  std::string floor, shading_normals = "light";
  double time_limit = 600;
};

ReferenceParameters resolved(const ReferenceOptions& options) {
  ReferenceParameters p = options.parameters;
  p.occlusion = !options.no_occlusion;
  p.shading_normals = *shading_normals_named(options.shading_normals);
  if (options.floor.empty()) return p;
  p.floor = *parse_percent(options.floor);
  p.time_limit = options.time_limit;
  return p;
}

std::string check_floor(const std::string& text) {
  const double floor = parse_percent(text).value_or(0);
  return floor > 0 && floor < 200 ? "" : "give percent of SMAPE, above 0 and under 200, such as 2%";
}

void write_images(const ReferenceOptions& options, const Scene& scene, const ReferenceResult& r,
                  const std::string& stem) {
  Labels labels = radiance_image_labels("indirect radiance, ray-traced reference", scene.name, scene.hash);
  labels.insert({{"reference", r.hash},
                 {"samples", fmt::format("{}", r.samples)},
                 {"seed", fmt::format("{}", options.parameters.seed)}});
  write_exr(options.out / (stem + ".reference.exr"), r.mean, r.mask, labels);
  const float exposure = auto_exposure(r.mean, r.mask);
  labels.erase("A");
  labels["exposure"] = fmt::format("{}", exposure);
  write_png(options.out / (stem + ".reference.png"), tone_map(r.mean, exposure), labels);
}

void compute(const ReferenceOptions& options) {
  const ReferenceParameters parameters = resolved(options);
  ensure_writable_directory(options.out);
  const Scene scene = load_scene(options.scene, {data_root() / "scenes", assets_directory(options.assets)});
  for (const std::string& warning : scene.warnings) log_warning("{}: {}", scene.name, warning);
  require_reference_memory(parameters.width, parameters.height);
  bool cached = false;
  const ReferenceResult r = load_or_compute(scene, parameters, &cached);
  const std::string stem = file_name(scene.name) + (options.no_occlusion ? ".no-occlusion" : "");
  write_images(options, scene, r, stem);
  if (const auto doubt = doubt_about(scene, r)) log_warning("{}: {}", scene.name, *doubt);
  fmt::print(
      "{}{}: {} triangles, {} samples in {} batches{}, {:.1f} M rays in {} ({}), noise floor {:.2f} % "
      "SMAPE{}, "
      "standard error of the mean {:.3f} %, hash {}\n",
      printable(scene.name), options.no_occlusion ? " without occlusion" : "", scene.triangles.size(),
      r.samples, r.batches, rounding_of(r, parameters), static_cast<double>(r.rays) * 1e-6,
      format_duration(r.seconds), cached ? "from the cache" : "computed", r.noise_floor_smape,
      end_of_search(r, parameters), 100 * r.standard_error, r.hash);
  fmt::print("{}\n", printable((options.out / (stem + ".reference.exr")).string()));
}

}  // namespace

void add_reference_command(CLI::App& app, CommandResult*) {
  auto options = std::make_shared<ReferenceOptions>();
  CLI::App* command =
      app.add_subcommand("reference", "compute a scene's ground truth, or fetch it from the cache");
  command->footer("Example: vsglbench reference cornell --width 480 --height 272 --samples 512 --out .");
  command->add_option("scene,--scene", options->scene, "NAME or NAME:VIEW, a scene.json or a glTF file")
      ->required();
  command->add_option("--out", options->out, "folder of the EXR and PNG")->capture_default_str();
  command->add_option("--assets", options->assets, "folder of downloaded scenes (default $VSGLBENCH_ASSETS)");
  command->add_option("--width", options->parameters.width, "pixels")
      ->check(CLI::Range(1, 16384))
      ->capture_default_str();
  command->add_option("--height", options->parameters.height, "pixels")
      ->check(CLI::Range(1, 16384))
      ->capture_default_str();
  command->add_option("--samples", options->parameters.samples, "a pixel and strategy")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  command
      ->add_option("--batches", options->parameters.batches,
                   "independent estimates that the noise is told from; even")
      ->check(CLI::Range(2, 1024))
      ->capture_default_str();
  command->add_option("--floor", options->floor, "go on until this noise floor is reached, such as 2%")
      ->check(CLI::Validator(check_floor, "PERCENT"));
  command->add_option("--time-limit", options->time_limit, "seconds after which the search for --floor ends")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option("--shading-normals", options->shading_normals,
                   "convention at the first bounce, see README: light or camera")
      ->check(CLI::IsMember({"light", "camera"}))
      ->capture_default_str();
  command->add_option("--seed", options->parameters.seed, "of the random numbers")
      ->check(CLI::Range(uint64_t{0}, (uint64_t{1} << 53) - 1))
      ->capture_default_str();
  command->add_flag("--no-occlusion", options->no_occlusion, "ignore occluders between the two bounces");
  command->callback([=] { compute(*options); });
}

}  // namespace vsglbench
