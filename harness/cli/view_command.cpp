#include <fmt/format.h>

#include <algorithm>

#include "base/child.h"
#include "base/error_list.h"
#include "base/file.h"
#include "base/log.h"
#include "cli/scene_arguments.h"
#include "cli/scene_commands.h"
#include "method/registry.h"
#include "report/image_labels.h"
#include "run/overrides.h"
#include "run/scene_images.h"
#include "run/view_sheet.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

struct ViewCommand {
  std::vector<std::string> what;
  fs::path out = ".";
  ViewSheetOptions sheet;
  uint32_t width = 0, height = 0, rsm = 0;  // 0: the config's, or the standard ones
  double time_limit = 300;
};

std::vector<ViewedCase> cases_of(const ViewCommand& options) {
  std::vector<ViewedCase> cases;
  for (const std::string& what : options.what) {
    if (is_scene_path(what) || is_scene_name(what)) {
      cases.push_back({.scene = what});
    } else {
      const auto more = viewed_cases(load_config(config_path(what)).cases);
      cases.insert(cases.end(), more.begin(), more.end());
    }
  }
  for (ViewedCase& c : cases) {
    if (options.width > 0) c.frame.width = options.width;
    if (options.height > 0) c.frame.height = options.height;
    if (options.rsm > 0) c.frame.rsm = options.rsm;
    c.frame.lights = std::min(c.frame.lights, c.frame.rsm * c.frame.rsm);
  }
  return cases;
}

// In a process of its own, as a method may crash or hang.
void draw(const ViewCommand& options, ViewedCase viewed, const fs::path& path) {
  Child child([&](const ToParent& parent) {
    try {
      if (viewed.method_parameters.empty())
        viewed.method_parameters = resolve_parameters(find_method(viewed.method), Json::object());
      write_png(path,
                view_sheet(viewed, options.sheet,
                           [&](const std::string& action) {
                             parent.send({{"now", action}});
                           }),
                image_labels("direct and indirect light, normals, RSM and PDF", viewed.scene));
      parent.send({{"done", true}});
    } catch (const ErrorList& e) {
      parent.send({{"errors", e.lines()}, {"kind", static_cast<int>(e.kind())}});
    } catch (const Error& e) {
      parent.send({{"errors", {e.what()}}, {"kind", static_cast<int>(e.kind())}});
    }
  });
  std::string action = "starting";
  while (const auto message = child.receive(options.time_limit)) {
    if (message->contains("done")) return;
    if (message->contains("errors"))
      throw ErrorList(static_cast<ErrorKind>(message->at("kind").get<int>()),
                      message->at("errors").get<std::vector<std::string>>());
    action = message->at("now");
  }
  throw fail(child.timed_out() ? ErrorKind::timeout : ErrorKind::crashed, "{} while {}: {}", viewed.scene,
             action, child.how_it_ended());
}

void show(const ViewCommand& options) {
  ensure_writable_directory(options.out);
  for (const ViewedCase& viewed : cases_of(options)) {
    const fs::path path = options.out / (file_name(viewed.scene) + ".view.png");
    draw(options, viewed, path);
    fmt::print("{}\n", path.string());
  }
}

}  // namespace

void add_view_command(CLI::App& app) {
  auto options = std::make_shared<ViewCommand>();
  CLI::App* command =
      app.add_subcommand("view", "a scene as one looks at it while placing a camera: one PNG, in seconds");
  command->footer(
      "Direct light (exact, at an exposure of its own), indirect light, normals, the RSM and the PDF of "
      "lights; no\n"
      "reference. Of a config each scene with its first case.\n"
      "Examples: vsglbench view model.glb; vsglbench view my-scene/scene.json:door --out /tmp; vsglbench "
      "view quick");
  command
      ->add_option("what", options->what, "a config, a scene's name or scene.json, or a glTF file; several")
      ->required();
  command->add_option("--out", options->out, "folder of the PNGs, named after the scenes")
      ->capture_default_str();
  command->add_option("--width", options->width, "pixels (480, or the config's)")
      ->check(CLI::Range(1, 16384));
  command->add_option("--height", options->height, "pixels (270, or the config's)")
      ->check(CLI::Range(1, 16384));
  command->add_option("--rsm", options->rsm, "texels along the RSM's edge (256, or the config's)")
      ->check(CLI::Range(1, 16384));
  command
      ->add_option("--time-limit", options->time_limit,
                   "seconds after which a step without a sign of life is ended")
      ->check(CLI::Range(0.1, 1e6))
      ->capture_default_str();
  command->add_option("--assets", options->sheet.assets,
                      "folder of downloaded scenes (default $VSGLBENCH_ASSETS)");
  command->add_option("--device", options->sheet.device,
                      "Vulkan device: index, UUID, PCI address or part of its name");
  command->callback([=] { show(*options); });
}

}  // namespace vsglbench
