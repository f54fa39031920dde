#include <fmt/format.h>

#include <algorithm>

#include "base/file.h"
#include "cli/command.h"
#include "method/registry.h"
#include "run/effect_prices.h"
#include "run/runner.h"
#include "run/scene_effects.h"
#include "run/visibility_tracer.h"
#include "scene/scene_file.h"

namespace vsglbench {
namespace {

struct EffectsOptions {
  std::string scene, method = "mfis", device;
  std::filesystem::path assets;
  FrameParameters frame{.width = 320, .height = 180, .rsm = 128, .importance_lights = 256};
  std::string visibility = "none";
  uint32_t rounds = 8;
  bool price = false, json = false;
};

std::string price_cell(const EffectReport& e) {
  if (!e.ms) return "";
  return fmt::format("{:+.2f} ms [{:.2f} … {:.2f}], {:+.2f} MiB", *e.ms, e.ms_ci95->lo, e.ms_ci95->hi,
                     static_cast<double>(*e.bytes) / (1 << 20));
}

void print(const std::vector<EffectReport>& ledger, bool priced) {
  size_t name_width = 0, price_width = 0;
  for (const EffectReport& e : ledger) {
    name_width = std::max(name_width, e.name.size());
    price_width = std::max(price_width, price_cell(e).size());
  }
  for (const EffectReport& e : ledger) {
    const std::string price = priced ? fmt::format("{:<{}}  ", price_cell(e), price_width) : "";
    fmt::print("{:<{}}  {}  {}{}\n", e.name, name_width, e.needed ? "needed " : "skipped", price, e.reason);
  }
}

void print_json(const std::vector<EffectReport>& ledger) {
  Json rows = Json::array();
  for (const EffectReport& e : ledger) {
    Json row = {{"name", e.name}, {"needed", e.needed}, {"reason", e.reason}, {"passes", e.passes}};
    if (e.ms) {
      row["ms"] = *e.ms;
      row["ms_ci95"] = {e.ms_ci95->lo, e.ms_ci95->hi};
      row["bytes"] = *e.bytes;
    }
    rows.push_back(row);
  }
  fmt::print("{}\n", rows.dump(2));
}

EffectSaving price(const EffectsOptions& options, const Scene& scene, SceneEffects& effects,
                   std::vector<EffectReport>* ledger) {
  Device device({.select = options.device});
  KernelLibrary kernels(device);
  Stage stage(device, kernels, scene);
  const MethodInfo& method = load_method(options.method, device.info());
  PricedFrame frame{method, resolve_parameters(method, Json::object()), options.frame, {}};
  frame.parameters.effects = effects.of(frame.parameters);
  return price_effects(stage, frame, options.rounds, ledger);
}

void show(EffectsOptions options) {
  options.frame.visibility = parse_visibility(options.visibility);
  const Scene scene = load_scene(options.scene, {data_root() / "scenes", assets_directory(options.assets)});
  SceneEffects effects(scene);
  auto rows = ledger(effects.decisions(options.frame.width, options.frame.height));
  EffectSaving saving;
  if (options.price) saving = price(options, scene, effects, &rows);
  if (options.json) return print_json(rows);
  print(rows, options.price);
  if (!options.price) return;
  const auto mib = [](int64_t bytes) { return static_cast<double>(bytes) / (1 << 20); };
  fmt::print(
      "{} of {}: {:.1f} ms and {:.1f} MiB as the scene calls for, {:.1f} ms and {:.1f} MiB with all effects: "
      "{:.2f} times; without gbuffer and rsm {:.2f} times\n"
      "ms: what an effect adds to a frame, whether it is needed or skipped; MiB: to its images and buffers\n",
      options.method, scene.name, saving.derived_span_ms.median, mib(saving.derived_bytes),
      saving.forced_span_ms.median, mib(saving.forced_bytes),
      saving.forced_span_ms.median / saving.derived_span_ms.median,
      saving.forced_ms.median / saving.derived_ms.median);
}

}  // namespace

void add_effects_command(CLI::App& app) {
  auto options = std::make_shared<EffectsOptions>();
  CLI::App* command = app.add_subcommand(
      "effects", "which effects a scene calls for and why; what no effect asks for is not simulated");
  command->footer(
      "Nothing is rendered without --price. `run --force-effects` and `--skip-effects` turn effects on and "
      "off.\n"
      "Example: vsglbench effects cornell --price");
  command->add_option("scene", options->scene, "scene, with :VIEW; a name or a path")->required();
  command->add_flag("--price", options->price, "render frames with and without each effect, and time them");
  command->add_option("--method", options->method, "of the priced frames")->capture_default_str();
  command->add_option("--lights", options->frame.lights, "N of the priced frames")->capture_default_str();
  command->add_option("--importance-lights", options->frame.importance_lights, "of the priced frames")
      ->check(CLI::Range(1, 1 << 24))
      ->capture_default_str();
  command->add_option("--width", options->frame.width, "pixels")
      ->check(CLI::Range(1, 16384))
      ->capture_default_str();
  command->add_option("--height", options->frame.height, "pixels")
      ->check(CLI::Range(1, 16384))
      ->capture_default_str();
  command->add_option("--rsm", options->frame.rsm, "texels along the RSM's edge")
      ->check(CLI::Range(1, 16384))
      ->capture_default_str();
  command->add_option("--visibility", options->visibility, "of the priced frames: none or shadow maps")
      ->check(CLI::IsMember({"none", "ism", "aism", "tism"}))
      ->capture_default_str();
  command->add_option("--rounds", options->rounds, "frames of each kind")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_flag("--json", options->json, "as JSON");
  command->add_option("--assets", options->assets, "folder of downloaded scenes (default $VSGLBENCH_ASSETS)");
  command->add_option("--device", options->device,
                      "Vulkan device: index, UUID, PCI address or part of its name");
  command->callback([=] { show(*options); });
}

}  // namespace vsglbench
