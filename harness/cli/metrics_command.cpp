#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/json.h"
#include "cli/command.h"
#include "image/exr.h"
#include "image/flip.h"

namespace vsglbench {
namespace {

namespace fs = std::filesystem;

struct MetricsOptions {
  fs::path reference, test, mask;
  bool json = false;
};

// A picture and, where the file has a channel A, the pixels that it counts.
struct Picture {
  fs::path path;
  Image image;
  Mask counted;
};

Mask above_zero(const fs::path& path, const char* channel, const std::vector<float>& values) {
  Mask mask(values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]))
      throw fail(ErrorKind::case_failed, "{}: channel {} holds a NaN or Inf", path.string(), channel);
    mask[i] = values[i] > 0;
  }
  return mask;
}

Picture read_picture(const fs::path& path) {
  ExrLayers layers = read_exr_layers(path);
  const auto alpha = layers.scalars.find("A");
  Picture picture{path, read_exr(path), {}};
  if (alpha != layers.scalars.end()) picture.counted = above_zero(path, "A", alpha->second);
  const Health health = check_health(picture.image);
  if (health.finite()) return picture;
  throw fail(ErrorKind::case_failed,
             "{}: {} NaN and {} Inf pixels, the first at ({}, {}); no metric is defined", path.string(),
             health.nan, health.inf, health.first_bad->x, health.first_bad->y);
}

// Channel A where the file has one, else whatever of R, G and B is above 0, else its only channel.
Mask read_mask(const fs::path& path, const Image& like) {
  const ExrLayers layers = read_exr_layers(path);
  if (layers.width != like.width || layers.height != like.height) {
    throw fail(ErrorKind::usage, "{}: the mask is {}x{} but the images {}x{}", path.string(), layers.width,
               layers.height, like.width, like.height);
  }
  const auto alpha = layers.scalars.find("A");
  if (alpha != layers.scalars.end()) return above_zero(path, "A", alpha->second);
  if (layers.colors.contains("")) {
    std::vector<float> brightest;
    for (const glm::vec3& c : layers.colors.at("").pixels) brightest.push_back(std::max({c.x, c.y, c.z}));
    return above_zero(path, "R, G or B", brightest);
  }
  if (layers.scalars.size() == 1) return above_zero(path, "of the mask", layers.scalars.begin()->second);
  throw fail(ErrorKind::usage, "{}: a mask needs a channel A, R, G and B, or one channel alone",
             path.string());
}

struct Counted {
  Mask mask;  // empty: every pixel
  std::string by;
};

Counted count_pixels(const MetricsOptions& options, const Picture& r, const Picture& x) {
  if (!options.mask.empty()) return {read_mask(options.mask, r.image), "mask"};
  if (r.counted.empty() && x.counted.empty()) return {{}, "all"};
  Mask mask(r.image.pixels.size(), 1);
  for (const Picture* p : {&r, &x}) {
    for (size_t i = 0; i < p->counted.size(); ++i) mask[i] = mask[i] && p->counted[i];
  }
  return {mask, "A"};
}

void check_sizes(const Picture& r, const Picture& x) {
  if (r.image.width == x.image.width && r.image.height == x.image.height) return;
  throw fail(ErrorKind::usage, "{} is {}x{} but {} is {}x{}; metrics need images of one size",
             x.path.string(), x.image.width, x.image.height, r.path.string(), r.image.width, r.image.height);
}

Json metrics_json(const Errors& errors, const std::optional<FlipErrors>& flip) {
  Json all = Json::object();
  for (const Metric m : kMetrics) {
    const MetricFormula& f = formula(m);
    Json entry = {{"formula", f.id}, {"expression", f.expression}, {"constants", f.constants}};
    const auto value = errors.value(m);
    entry[value ? "value" : "undefined"] = value ? Json(*value) : Json("the reference is black");
    all[f.name] = entry;
  }
  if (flip) {
    all["flip"]["p99"] = flip->p99;
    all["flip"]["constants"]["start_exposure"] = flip->exposures.start;
    all["flip"]["constants"]["stop_exposure"] = flip->exposures.stop;
    all["flip"]["constants"]["exposures"] = flip->exposures.count;
  }
  if (errors.lit_share) all["smape_lit"]["lit_share"] = *errors.lit_share;
  return all;
}

void print_text(const Errors& e, const std::optional<FlipErrors>& flip, const ErrorQuantiles& q,
                const std::string& counted) {
  const auto line = [](const char* name, const std::optional<double>& v, double scale, const char* unit,
                       const std::string& note) {
    const std::string number =
        v ? fmt::format("{:.6g}{}", scale * *v, unit) : "undefined: the reference is black";
    fmt::print("{:<10} {}{}\n", name, number, v ? note : "");
  };
  line("smape", e.smape, 1, " %", "");
  line("smape_lit", e.smape_lit, 1, " %",
       e.lit_share ? fmt::format("  over {:.2f} % of the pixels", 100 * *e.lit_share) : "");
  line("rmse", e.rmse, 1, "", "");
  line("rrmse", e.rrmse, 1, "", "");
  line("mrse", e.mrse, 1, "", "");
  line("bias", e.bias, 100, " %", "");
  line("flip", e.flip, 1, "",
       flip ? fmt::format("  p99 {:.6g}, {} exposures from {:+.4f} to {:+.4f} stops", flip->p99,
                          flip->exposures.count, flip->exposures.start, flip->exposures.stop)
            : "");
  fmt::print("relative error of luminance: p50 {:.4g} %, p99 {:.4g} %, p99.9 {:.4g} %\n", q.p50, q.p99,
             q.p999);
  if (e.p99_9) fmt::print("error of luminance over its mean: p99.9 {:.6g}\n", *e.p99_9);
  fmt::print("pixels     {} ({})\n", e.pixels, counted);
}

void measure(const MetricsOptions& options) {
  const Picture r = read_picture(options.reference), x = read_picture(options.test);
  check_sizes(r, x);
  const Counted counted = count_pixels(options, r, x);
  if (!counted.mask.empty() &&
      std::none_of(counted.mask.begin(), counted.mask.end(), [](uint8_t m) { return m; })) {
    throw fail(
        ErrorKind::case_failed, "{}; see --mask",
        counted.by == "A" ? "channel A is 0 at every pixel of one file or the other" : "the mask is empty");
  }
  Errors errors = measure_errors(x.image, r.image, counted.mask);
  const std::optional<FlipErrors> flip = measure_flip(x.image, r.image, counted.mask);
  if (flip) errors.flip = flip->mean;
  const ErrorQuantiles quantiles = error_quantiles(x.image, r.image, counted.mask);
  if (!options.json) {
    return print_text(errors, flip, quantiles,
                      counted.by == "all" ? "all"
                      : counted.by == "A" ? "where channel A is above 0"
                                          : "of the mask");
  }
  Json out = {{"reference", options.reference.string()},
              {"test", options.test.string()},
              {"width", r.image.width},
              {"height", r.image.height},
              {"pixels", errors.pixels},
              {"counted", counted.by},
              {"metrics", metrics_json(errors, flip)},
              {"quantiles", {{"p50", quantiles.p50}, {"p99", quantiles.p99}, {"p99_9", quantiles.p999}}}};
  if (errors.p99_9) out["p99_9"] = *errors.p99_9;
  fmt::print("{}\n", out.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace

void add_metrics_command(CLI::App& app, CommandResult*) {
  auto options = std::make_shared<MetricsOptions>();
  CLI::App* command =
      app.add_subcommand("metrics", "every metric of the report for two EXR files, anybody's");
  command->footer(
      "Linear Rec.709 in channels R, G and B, float or half. Pixels count where channel A is above 0 in both "
      "files (a file without A: everywhere), or where --mask says so.\n"
      "Example: vsglbench metrics reference.exr test.exr --json");
  command->add_option("reference", options->reference, "EXR file")->required();
  command->add_option("test", options->test, "EXR file")->required();
  command->add_option(
      "--mask", options->mask,
      "EXR file whose channel A, else R, G or B, else only channel is above 0 where pixels count");
  command->add_flag("--json", options->json, "as JSON, with formulas and constants");
  command->callback([=] { measure(*options); });
}

}  // namespace vsglbench
