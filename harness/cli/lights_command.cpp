#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "base/error.h"
#include "base/printable.h"
#include "cli/command.h"
#include "cli/scene_arguments.h"
#include "run/config.h"
#include "run/lights_run.h"

namespace vsglbench {
namespace {

std::string number(const std::optional<double>& value) { return value ? fmt::format("{:.4f}", *value) : "-"; }

// 0 drawn or skipped, 1 one failed, 2 none is drawn since no scene is there.
int print(const std::vector<LightsResult>& results) {
  size_t width = 4;
  for (const LightsResult& r : results) width = std::max(width, r.id.size());
  fmt::print("{:<{}}  {:>4}  {:>7}  {:>9}  {:>8}  {:>9}  {:>8}  {:>9}\n", "case", width, "seed", "lights",
             "overlap", "gap", "overlap_p", "gap_p", "largest");
  std::set<std::string> told;  // reasons that cases share, such as an absent asset
  for (const LightsResult& r : results) {
    if (r.status != Status::ok) {
      const bool fresh = told.insert(r.error).second;
      fmt::print("{:<{}}  {:>4}  {}: {}\n", printable(r.id), width, r.seed, name(r.status),
                 fresh ? r.error : "as said above");
      continue;
    }
    const auto& c = r.coverage;
    fmt::print("{:<{}}  {:>4}  {:>7}  {:>9}  {:>8}  {:>9}  {:>8}  {:>9}\n", printable(r.id), width, r.seed,
               r.lights - r.empty, c ? number(c->overlap) : "-", c ? number(c->gap) : "-",
               number(c ? c->pdf_overlap : std::nullopt), number(c ? c->pdf_gap : std::nullopt),
               r.kernels ? number(r.kernels->largest) : "-");
  }
  const auto all = [&](Status s) {
    return std::all_of(results.begin(), results.end(), [&](const auto& r) { return r.status == s; });
  };
  if (all(Status::skipped)) throw fail(ErrorKind::scene, "nothing is drawn: {}", results.front().error);
  const auto failed = [](const LightsResult& r) { return r.status == Status::failed; };
  return std::any_of(results.begin(), results.end(), failed) ? 1 : 0;
}

}  // namespace

void add_lights_command(CLI::App& app, const std::vector<std::string>& argv, CommandResult* result) {
  auto options = std::make_shared<LightsOptions>();
  auto format = std::make_shared<std::string>("json");
  CLI::App* command =
      app.add_subcommand("lights", "draw the lights of an experiment's cases, and write them as JSON or CSV");
  command->footer(
      "OUT/SCENE/METHOD/PARAMETERS/ of each case holds\n"
      "  rsm.png      the PDF on the RSM, the footprints' centres and squares or the clusters [MFIS16 Fig. "
      "1]\n"
      "  scene.png    each light as a disk of its sigma, as the camera sees it [VSGL14 Fig. 2]\n"
      "  moments.png  of methods that filter the RSM by its mips: power, direction of both lobes, position "
      "and its\n"
      "               squared norm, level by level [MFIS16 Fig. 4]\n"
      "  lights.json  schema vsglbench.lights/2: argv, git, device, config, case, scene, method, "
      "parameters,\n"
      "               seed, kind (vsgl, vpl, vsl), count, empty (without power; not listed), coverage, "
      "edges,\n"
      "               lights\n"
      "or lights.csv, a row a light; and OUT/coverage.csv has a row a case and seed. A light is\n"
      "  VSGL      index, mean (world, m), sigma (m), power (luminance of the reflected power, W), level of "
      "its\n"
      "            footprint, and two lobes, diffuse and specular: axis, sharpness, amplitude (RGB, W/sr)\n"
      "  VPL, VSL  index, position (world, m), power (luminance) and flux (RGB) that come in, W, incident, "
      "normal,\n"
      "            geometric_normal, brdf (diffuse, f0, ndf with alpha or exponent), radius (m), clamp "
      "(1/m2)\n"
      "  footprint x, y, side in texels of the RSM, where the method has square footprints, and edge_share: "
      "the part\n"
      "            of the pairs of neighbouring texels under it between which the geometry is discontinuous\n"
      "  mass      what that footprint holds of the PDF, as a multiple of 1/N: 1 is as intended [MFIS16 Eq. "
      "2]\n"
      "coverage: of c, how often lights hold a texel by the weights of their filters' taps, overlap is the "
      "mean of\n"
      "max(c - 1, 0), gap of max(1 - c, 0); pdf_overlap and pdf_gap the same weighted by the PDF; "
      "kernel_largest is\n"
      "the largest mass (in the printed table largest), kernel_over the share of footprints whose mass is "
      "above "
      "4.\n"
      "edges: of lights whose squares are 2 texels wide or more, how many have an edge_share above 0.05 "
      "(lights_on)\n"
      "and how many have not; medians of the former over the latter, with bootstrapped 95 % intervals, "
      "absent "
      "where\n"
      "either are fewer than 8: sigma_ratio of sigma over the square's side in metres, density_ratio of "
      "power/(2 pi\n"
      "sigma2). \"Larger and darker on discontinuous geometries\" [VSGL14 Fig. 2] is above 1, and below 1.\n"
      "A config with \"measure\": \"generation\" gives all methods the PDF that its key pdf names, any other "
      "each "
      "its own.\n"
      "Exit codes: 0 all drawn or skipped (scene not downloaded), 1 a case failed, 2 bad usage, config, "
      "plugin or\n"
      "output, or all skipped, 3 no usable device.\n"
      "Example: vsglbench lights mfis16-fig1 --case 'cornell/fis/*' --case 'cornell/mfis/*'");
  const ExperimentOption experiment(command);
  command->add_option("--case", options->cases,
                      "only the cases whose id matches this glob; may come again (default: all)");
  command->add_option("--seed", options->seed, "of the lights' lattice")->capture_default_str();
  command
      ->add_option("--seeds", options->seeds,
                   "so many from --seed on have rows in coverage.csv; pictures and lists are of --seed alone")
      ->check(CLI::Range(1u, 1000000u))
      ->capture_default_str();
  command->add_option("--out", options->out, "folder for the files (default reports/out/NAME/lights)");
  command->add_option("--format", *format, "of the list of lights")
      ->check(CLI::IsMember({"json", "csv"}))
      ->capture_default_str();
  command->add_option("--scale", options->scale,
                      "of the config's scales, such as quick: its keys replace the config's");
  command->add_option("--assets", options->assets, "folder of downloaded scenes (default $VSGLBENCH_ASSETS)");
  command->add_option("--device", options->device,
                      "Vulkan device: index, UUID, PCI address or part of its name");
  command->callback([=] {
    if (options->seeds - 1 > std::numeric_limits<uint32_t>::max() - options->seed)
      throw fail(ErrorKind::usage, "--seed {} has no {} seeds from there on", options->seed, options->seeds);
    const Experiment given = experiment.get();
    options->config = given.config;
    options->scenes = given.scenes;
    options->csv = *format == "csv";
    options->argv = argv;
    result->exit_code = print(run_lights(*options));
  });
}

}  // namespace vsglbench
