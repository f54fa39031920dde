#include <fmt/format.h>

#include <filesystem>

#include "base/error.h"
#include "base/file.h"
#include "cli/command.h"
#include "figure/figure.h"
#include "report/environment.h"
#include "run/config.h"
#include "run/runner.h"

namespace vsglbench {
namespace {

struct FigureOptions {
  std::string figure, device, assets;
  std::filesystem::path out;
  uint32_t width = 0, height = 0;
};

// What was drawn, from what, on what.
Json provenance(const FigureInputs& inputs, const FigureOutput& figure,
                const std::vector<std::string>& argv) {
  const DeviceInfo& d = inputs.device.info();
  const HostInfo host = host_info();
  Json claims = Json::array();
  for (const Claim& c : figure.claims) {
    claims.push_back({{"claim", c.text}, {"source", c.source}, {"holds", c.holds}, {"figures", c.figures}});
  }
  return {{"schema", "vsglbench.figure/1"},
          {"argv", argv},
          {"config", inputs.config},
          {"claims", claims},
          {"git", {{"commit", build_git().commit}, {"dirty", build_git().dirty}}},
          {"device",
           {{"name", d.name}, {"type", d.type}, {"driver", d.driver}, {"driver_version", d.driver_version}}},
          {"host", {{"cpu", host.cpu}, {"cores", host.cores}}}};
}

void draw(const FigureOptions& o, const std::vector<std::string>& argv) {
  const Json config = load_figure_config(config_path(o.figure), o.width, o.height);
  const std::string name = config.at("figure");
  const auto folder = o.out.empty() ? std::filesystem::path("reports/out") / name : o.out;
  ensure_writable_directory(std::filesystem::absolute(folder));
  Device device({.select = o.device});
  const FigureInputs inputs{device, config, assets_directory(o.assets)};
  const FigureOutput figure = make_figure(inputs);
  for (const auto& path : write_figure(figure, folder)) fmt::print("{}\n", path.string());
  const auto report = folder / (name + ".json");
  write_text(report, provenance(inputs, figure, argv).dump(2) + "\n");
  fmt::print("{}\n", report.string());
  for (const FigureTable& table : figure.tables) {
    if (table.rows.size() <= 20) fmt::print("\n{}", table.csv());
  }
  fmt::print("\n");
  for (const Claim& c : figure.claims) {
    fmt::print("{} {}: {} ({})\n", c.source, c.holds ? "holds" : "does not hold here", c.text, c.figures);
  }
}

}  // namespace

void add_figure_command(CLI::App& app, const std::vector<std::string>& argv, CommandResult*) {
  auto options = std::make_shared<FigureOptions>();
  CLI::App* command =
      app.add_subcommand("figure", "reproduce a paper's figure: CSV, SVG, PNG, and whether its claims hold");
  command->footer(
      "A claim that does not hold is a finding, no failure.\n"
      "Example: vsglbench figure sgl22-1 --out figures");
  command
      ->add_option("figure", options->figure, "config of the figure: a file, or the name of one in configs/")
      ->required();
  command->add_option("--out", options->out, "folder for the files (default reports/out/FIGURE)");
  command->add_option("--width", options->width, "pixels, instead of the config's")
      ->check(CLI::Range(1, 16384));
  command->add_option("--height", options->height, "pixels, instead of the config's")
      ->check(CLI::Range(1, 16384));
  command->add_option("--assets", options->assets, "folder of downloaded scenes (default $VSGLBENCH_ASSETS)");
  command->add_option("--device", options->device, "Vulkan device: index or part of its name");
  command->callback([=] { draw(*options, argv); });
}

}  // namespace vsglbench
