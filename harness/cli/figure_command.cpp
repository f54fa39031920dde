#include <fmt/format.h>

#include <filesystem>

#include "base/error.h"
#include "base/file.h"
#include "cli/command.h"
#include "figure/drawing.h"
#include "figure/gnuplot.h"
#include "report/environment.h"
#include "run/config.h"
#include "run/memory.h"
#include "run/runner.h"

namespace vsglbench {
namespace {

struct FigureOptions {
  std::string figure, device, assets;
  std::filesystem::path out;
  uint32_t width = 0, height = 0;
  double silence_s = 600;
};

// What was drawn, from what, on what.
Json provenance(const Json& config, const DrawnFigure& figure, const std::vector<std::string>& argv) {
  const HostInfo host = host_info();
  Json claims = Json::array();
  for (const Claim& c : figure.claims) {
    const Json holds = c.finding == Finding::undecided ? Json() : Json(c.finding == Finding::holds);
    claims.push_back({{"claim", c.text}, {"source", c.source}, {"holds", holds}, {"figures", c.figures}});
  }
  return {{"schema", "vsglbench.figure/1"},
          {"argv", argv},
          {"config", config},
          {"claims", claims},
          {"git", {{"commit", build_git().commit}, {"dirty", build_git().dirty}}},
          {"device", figure.device},
          {"host", {{"cpu", host.cpu}, {"cores", host.cores}}}};
}

// Throws Error(case_failed) for a frame that is larger than the memory.
void require_room(const Json& config, const DeviceInfo& device) {
  if (!config.contains("rsm")) return;
  Case c;
  c.frame.width = config["width"];
  c.frame.height = config["height"];
  c.frame.rsm = config["rsm"];
  c.frame.visibility = Visibility::none;
  require_memory(device, c);
}

void draw(const FigureOptions& o, const std::vector<std::string>& argv) {
  const Json config = load_figure_config(config_path(o.figure), o.width, o.height);
  const std::string name = config.at("figure");
  const auto folder = o.out.empty() ? std::filesystem::path("reports/out") / name : o.out;
  ensure_writable_directory(std::filesystem::absolute(folder));
  Gnuplot();  // where it is missing, that is said before the work
  const DrawnFigure figure = draw_figure({config, assets_directory(o.assets), folder, o.device, o.silence_s,
                                          [&](const DeviceInfo& device) { require_room(config, device); }});
  for (const auto& path : figure.paths) fmt::print("{}\n", path.string());
  const auto report = folder / (name + ".json");
  write_text(report, provenance(config, figure, argv).dump(2) + "\n");
  fmt::print("{}\n", report.string());
  for (const std::string& table : figure.short_tables) fmt::print("\n{}", table);
  fmt::print("\n");
  for (const Claim& c : figure.claims) {
    fmt::print("{} {}{}: {} ({})\n", c.source, finding_name(c.finding),
               c.finding == Finding::holds ? "" : " here", c.text, c.figures);
  }
}

}  // namespace

void add_figure_command(CLI::App& app, const std::vector<std::string>& argv, CommandResult*) {
  auto options = std::make_shared<FigureOptions>();
  CLI::App* command =
      app.add_subcommand("figure", "reproduce a paper's figure: CSV, SVG, PNG, and whether its claims hold");
  command->footer(
      "A claim that does not hold is a finding, no failure; so is one that the noise leaves undecided.\n"
      "Exit codes: 0 drawn, 1 the method failed, 2 bad usage, config, scene, plugin or output, 3 no usable "
      "device.\n"
      "Example: vsglbench figure sgl22-1 --out figures");
  command
      ->add_option("figure", options->figure, "config of the figure: a file, or the name of one in configs/")
      ->required();
  command->add_option("--out", options->out, "folder for the files (default reports/out/FIGURE)");
  command
      ->add_option("--width", options->width,
                   "pixels of image or frame, of the plot where there is none, instead of the config's")
      ->check(CLI::Range(1, 65536));
  command->add_option("--height", options->height, "the same of its height")->check(CLI::Range(1, 65536));
  command->add_option("--assets", options->assets, "folder of downloaded scenes (default $VSGLBENCH_ASSETS)");
  command
      ->add_option("--time-limit", options->silence_s,
                   "seconds that one step, such as a frame, may take before the figure is stopped")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--device", options->device,
                      "Vulkan device: index, UUID, PCI address or part of its name");
  command->callback([=] { draw(*options, argv); });
}

}  // namespace vsglbench
