#include <fmt/format.h>

#include "base/child.h"
#include "base/file.h"
#include "base/printable.h"
#include "cli/command.h"
#include "method/registry.h"
#include "report/ledger.h"
#include "run/effect_prices.h"
#include "run/memory.h"
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
  double time_limit = 300;  // seconds of a frame
  bool price = false, json = false;
};

Json json_of(const std::vector<EffectReport>& ledger) {
  Json rows = Json::array();
  for (const EffectReport& e : ledger) {
    Json row = {{"name", e.name}, {"needed", e.needed}, {"reason", e.reason}, {"passes", e.passes}};
    if (e.ms) row["ms"] = *e.ms;
    if (e.ms_ci95) row["ms_ci95"] = {e.ms_ci95->lo, e.ms_ci95->hi};
    if (e.bytes) row["bytes"] = *e.bytes;
    rows.push_back(row);
  }
  return rows;
}

EffectSaving price(const EffectsOptions& options, const Scene& scene, SceneEffects& effects,
                   const std::function<void(const std::string&)>& now, std::vector<EffectReport>* ledger) {
  Device device({.select = options.device});
  Case priced;
  priced.method = options.method;
  priced.frame = options.frame;
  require_memory(device.info(), priced);
  KernelLibrary kernels(device);
  Stage stage(device, kernels, scene);
  const MethodInfo& method = load_method(options.method, device.info());
  PricedFrame frame{method, resolve_parameters(method, Json::object()), options.frame, {}};
  frame.parameters.effects = effects.of(frame.parameters);
  return price_effects(stage, frame, {.rounds = options.rounds, .now = now}, ledger);
}

// A report's folder or file, not a scene's.
bool is_report(const std::string& path) {
  std::error_code ec;
  const std::filesystem::path file = report_file(path);
  if (!is_path(file.string()) || !std::filesystem::is_regular_file(file, ec)) return false;
  return read_text(file).find("\"vsglbench.report/") != std::string::npos;
}

void show_report(const EffectsOptions& options) {
  if (options.price)
    throw fail(ErrorKind::usage, "--price is of a scene; a report's prices come with `run --price-effects`");
  const Report report = read_report_at(options.scene);
  if (!options.json) return fmt::print("{}", ledgers_of(report));
  Json scenes = Json::object();
  for (const SceneReport& scene : report.scenes) scenes[scene.name] = json_of(scene.effects);
  fmt::print("{}\n", scenes.dump(2));
}

std::string text_of(const EffectsOptions& options, const std::function<void(const std::string&)>& now) {
  const Scene scene = load_scene(options.scene, {data_root() / "scenes", assets_directory(options.assets)});
  SceneEffects effects(scene);
  auto rows = ledger(effects.decisions(options.frame.width, options.frame.height));
  EffectSaving saving;
  if (options.price) saving = price(options, scene, effects, now, &rows);
  if (options.json) return json_of(rows).dump(2) + "\n";
  std::string out = ledger_text(rows);
  if (!options.price) return out;
  const auto mib = [](int64_t bytes) { return static_cast<double>(bytes) / (1 << 20); };
  return out +
         fmt::format(
             "{} of {}: {:.1f} ms and {:.1f} MiB as the scene calls for, {:.1f} ms and {:.1f} MiB with all "
             "effects: {:.2f} times; without gbuffer and rsm {:.2f} times\n"
             "ms: what an effect adds to a frame, whether it is needed or skipped; MiB: to its images and "
             "buffers\n",
             options.method, printable(scene.name), saving.derived_span_ms.median, mib(saving.derived_bytes),
             saving.forced_span_ms.median, mib(saving.forced_bytes),
             saving.forced_span_ms.median / saving.derived_span_ms.median,
             saving.forced_ms.median / saving.derived_ms.median);
}

// In a process of its own, as a method may crash or hang.
std::string priced_text_of(const EffectsOptions& options) {
  Child child([&](const ToParent& parent) {
    try {
      parent.send({{"text", text_of(options, [&](const std::string& action) {
                      parent.send({{"now", action}});
                    })}});
    } catch (const Error& e) {
      parent.send({{"error", e.what()}, {"kind", static_cast<int>(e.kind())}});
    }
  });
  std::string action = "starting";
  while (const auto message = child.receive(options.time_limit)) {
    if (message->contains("text")) return message->at("text");
    if (message->contains("error"))
      throw Error(static_cast<ErrorKind>(message->at("kind").get<int>()), message->at("error"));
    action = message->at("now");
  }
  throw fail(child.timed_out() ? ErrorKind::timeout : ErrorKind::crashed, "{} while {}: {}", options.method,
             action, child.how_it_ended());
}

void show(EffectsOptions options) {
  if (is_report(options.scene)) return show_report(options);
  options.frame.visibility = parse_visibility(options.visibility);
  fmt::print("{}", options.price ? priced_text_of(options) : text_of(options, {}));
}

}  // namespace

void add_effects_command(CLI::App& app) {
  auto options = std::make_shared<EffectsOptions>();
  CLI::App* command = app.add_subcommand(
      "effects", "which effects a scene calls for and why; what no effect asks for is not simulated");
  command->footer(
      "Nothing is rendered without --price. `run --price-effects` prices the ledger of a report; `run "
      "--force-effects` and\n`--skip-effects` turn effects on and off.\n"
      "Examples: vsglbench effects cornell --price; vsglbench effects reports/out/quick");
  command
      ->add_option("scene,--scene", options->scene,
                   "scene, with :VIEW, a name or a path; or a report: the ledgers that a run wrote into it")
      ->required();
  command->add_flag("--price", options->price, "render frames with and without each effect, and time them");
  command->add_option("--method", options->method, "of the priced frames")->capture_default_str();
  command->add_option("--lights", options->frame.lights, "N of the priced frames")
      ->check(CLI::Range(1, 1 << 24))
      ->capture_default_str();
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
  command
      ->add_option("--time-limit", options->time_limit,
                   "seconds after which a method that gives no sign is stopped")
      ->check(CLI::Range(0.1, 1e6))
      ->capture_default_str();
  command->add_flag("--json", options->json, "as JSON");
  command->add_option("--assets", options->assets, "folder of downloaded scenes (default $VSGLBENCH_ASSETS)");
  command->add_option("--device", options->device,
                      "Vulkan device: index, UUID, PCI address or part of its name");
  command->callback([=] { show(*options); });
}

}  // namespace vsglbench
