// [SGL22] Fig. 4: a scene's indirect light from few virtual SG lights, without visibility, by every diffuse
// model: the time of the shading pass, the error against quadrature, and black splotches: pixels darker than
// a share of what quadrature says, where that is bright enough to be seen.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/file.h"
#include "base/parallel.h"
#include "figure/model_times.h"
#include "figure/sgl22.h"
#include "frame/frame.h"
#include "measure/statistics.h"
#include "method/registry.h"
#include "scene/scene_file.h"
#include "shaders/shading_exact.h"

namespace vsglbench::sgl22 {
namespace {

// One frame a model, of one size, by default all models; they share targets and scratch memory.
std::vector<std::unique_ptr<Frame>> make_frames(
    Stage& stage, const Json& config, uint32_t width, uint32_t height,
    const std::vector<std::string>& diffuse = exact::diffuse_model_names()) {
  const MethodInfo& method = load_method(config["method"], stage.device.info());
  const Json parameters = resolve_parameters(method, config.value("parameters", Json::object()));
  FrameParameters p{.width = width,
                    .height = height,
                    .rsm = config["rsm"],
                    .lights = config.value("N", 0u),
                    .visibility = Visibility::none,
                    .importance = Importance::flux};
  std::vector<std::unique_ptr<Frame>> frames;
  for (const auto& model : diffuse) {
    p.shading["diffuse"] = model;
    frames.push_back(std::make_unique<Frame>(stage, method, parameters, p, nullptr));
    if (frames.back()->light_kind() == LightKind::vsgl) continue;
    throw fail(ErrorKind::config, "it makes no VSGLs; use a method that does, such as two-vsgl");
  }
  return frames;
}

// The image of a frame just rendered. Throws Error(case_failed) for lights or pixels that are not finite.
Image finite_image(const Frame& frame, const std::string& model) {
  if (const auto bad = frame.results().bad_values())
    throw fail(ErrorKind::case_failed, "not finite: {}", bad->message());
  Image image = frame.results().indirect();
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const glm::vec3& p = image.pixels[i];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
    throw fail(ErrorKind::case_failed, "its pixels are not finite, shaded by {}; the first is ({}, {})",
               model, i % image.width, i / image.width);
  }
  return image;
}

// What the camera sees, on the host, and its light by quadrature in double precision.
class ExactPixels {
 public:
  explicit ExactPixels(const Frame& frame)
      : camera_(frame.camera()), lights_(frame.results().lights().all<gpu::Vsgl>()) {
    const auto& targets = frame.gbuffer().maps;
    for (size_t i = 0; i < maps_.size(); ++i) maps_[i] = download_map(targets[i]);
  }
  bool surface(size_t pixel) const { return maps_[0][pixel].w > 0; }
  glm::vec3 radiance(size_t pixel) const {
    const glm::dvec3 position(maps_[0][pixel]);
    const glm::dvec3 view = camera_.perspective != 0 ? glm::normalize(glm::dvec3(camera_.position) - position)
                                                     : -glm::dvec3(camera_.forward);
    const exact::Surface s{position,        maps_[1][pixel], maps_[2][pixel],  view,
                           maps_[3][pixel], maps_[4][pixel], maps_[1][pixel].w};
    glm::dvec3 sum(0);
    for (const auto& light : lights_) sum += exact::shade_vsgl(s, light, {.quadrature = true});
    return sum;
  }

 private:
  gpu::Emitter camera_;
  std::vector<gpu::Vsgl> lights_;
  std::array<std::vector<glm::vec4>, 5> maps_;
};

ModelImages small_images(Stage& stage, const FigureInputs& inputs) {
  const Json& config = inputs.config;
  const auto least = [&](const char* key) {
    return std::min(config["image"][key].get<uint32_t>(), config[key].get<uint32_t>());
  };
  const uint32_t width = least("width"), height = least("height");
  ModelImages out;
  for (const auto& frame : make_frames(stage, config, width, height)) {
    const std::string& model = exact::diffuse_model_names()[out.images.size()];
    inputs.begin(fmt::format("a frame of {}×{}, {}", width, height, model));
    frame->render(0);
    out.images.push_back(finite_image(*frame, model));
    if (!out.mask.empty()) continue;
    inputs.begin(fmt::format("quadrature of {}×{} pixels", width, height));
    out.mask = frame->results().surface_mask();
    const ExactPixels exact(*frame);
    out.reference = Image(width, height);
    parallel_for(out.reference.pixels.size(), 0, [&](uint64_t i, unsigned) {
      if (exact.surface(i)) out.reference.pixels[i] = exact.radiance(i);
    });
  }
  return out;
}

double median_luminance(const ModelImages& images) {
  std::vector<double> all;
  for (size_t i = 0; i < images.mask.size(); ++i) {
    if (images.mask[i] != 0) all.push_back(luminance(images.reference.pixels[i]));
  }
  if (all.empty()) throw fail(ErrorKind::case_failed, "the camera sees no surface");
  return median(all);
}

// The frame at its full size.
struct Full {
  uint32_t lights = 0;
  ModelTimes times;
  std::vector<uint64_t> splotches;  // by model, pixels
};

double shade_time(const FrameTimes& times) {
  for (const auto& [pass, ms] : times.passes) {
    if (pass.stage == PassStage::shade && pass.step.empty()) return ms;
  }
  throw std::logic_error("a frame without a shade pass");
}

double middle_of(std::array<double, kModels> luminances) {
  std::ranges::nth_element(luminances, luminances.begin() + kModels / 2);
  return luminances[kModels / 2];
}

// What a splotch is, and whether the models' median, of which three follow the integral closely, is within a
// factor of two of quadrature wherever one may be.
struct Splotch {
  double share, least;
  bool median_is_close = true;
};

Splotch splotch_of(const Json& config, const ModelImages& images) {
  const Json& keys = config["splotch"];
  Splotch splotch{keys["share"], keys["least"].get<double>() * median_luminance(images)};
  for (size_t i = 0; i < images.mask.size(); ++i) {
    std::array<double, kModels> all;
    for (size_t k = 0; k < kModels; ++k) all[k] = luminance(images.images[k].pixels[i]);
    const double truth = luminance(images.reference.pixels[i]), middle = middle_of(all);
    if (images.mask[i] == 0 || truth < splotch.least) continue;
    splotch.median_is_close &= middle > 0.5 * truth && middle < 2 * truth;
  }
  return splotch;
}

// By model. Quadrature is asked only where the median leaves a doubt.
std::vector<uint64_t> count_splotches(const std::vector<std::vector<float>>& luminances,
                                      const ExactPixels& exact, const Splotch& splotch) {
  std::vector<std::atomic<uint64_t>> counts(kModels);
  parallel_for(luminances[0].size(), 0, [&](uint64_t i, unsigned) {
    if (!exact.surface(i)) return;
    std::array<double, kModels> all;
    for (size_t k = 0; k < kModels; ++k) all[k] = luminances[k][i];
    const double middle = middle_of(all), bound = splotch.share * middle;
    const auto sound = [&](double value) { return value >= 2 * bound; };
    const auto clear = [&](double value) { return sound(value) || value < 0.5 * bound; };
    if (splotch.median_is_close && (middle < 0.5 * splotch.least || std::ranges::all_of(all, sound))) return;
    const bool no_doubt =
        splotch.median_is_close && middle > 2 * splotch.least && std::ranges::all_of(all, clear);
    const double truth = no_doubt ? middle : luminance(exact.radiance(i));
    if (truth < splotch.least) return;
    for (size_t k = 0; k < kModels; ++k) counts[k] += !(all[k] >= splotch.share * truth);
  });
  return {counts.begin(), counts.end()};
}

Full full_frames(Stage& stage, const FigureInputs& inputs, const Splotch& splotch) {
  const Json& config = inputs.config;
  const uint32_t width = config["width"], height = config["height"];
  std::vector<std::string> diffuse = exact::diffuse_model_names();
  diffuse.push_back(name(exact::DiffuseModel::tokuyoshi2022));  // the twin
  const auto frames = make_frames(stage, config, width, height, diffuse);
  std::vector<std::vector<float>> luminances;
  for (size_t k = 0; k < frames.size(); ++k) {
    inputs.begin(fmt::format("a frame of {}×{}, {}", width, height, diffuse[k]));
    frames[k]->render(0);  // kernels are compiled now
    if (k == kModels) continue;
    std::vector<float> one;
    for (const glm::vec3& pixel : finite_image(*frames[k], diffuse[k]).pixels)
      one.push_back(luminance(pixel));
    luminances.push_back(std::move(one));
  }
  inputs.begin(fmt::format("quadrature of doubtful pixels of {}×{}", width, height));
  Full full{.lights = frames[0]->light_count()};
  full.splotches = count_splotches(luminances, ExactPixels(*frames[0]), splotch);
  // Whoever begins a round takes turns, too.
  std::vector<std::vector<double>> shade_ms(frames.size());
  for (size_t i = 0; i < config["repetitions"].get<size_t>(); ++i) {
    for (size_t turn = 0; turn < frames.size(); ++turn) {
      const size_t k = (i + turn) % frames.size();
      inputs.begin(fmt::format("repetition {} of {}×{}, {}", i + 1, width, height, diffuse[k]));
      shade_ms[k].push_back(shade_time(frames[k]->render(0)));
    }
  }
  std::vector<double> twin = std::move(shade_ms.back());
  shade_ms.pop_back();
  full.times = ModelTimes(std::move(shade_ms), std::move(twin));
  return full;
}

// Throws Error(case_failed) where the reference is black: an error relative to it means nothing.
void require_light(const Image& reference) {
  if (std::ranges::any_of(reference.pixels, [](const glm::vec3& p) { return luminance(p) > 0; })) return;
  throw fail(ErrorKind::case_failed, "its lights light nothing that the camera sees");
}

std::vector<Claim> claims_of(const Full& full, const std::vector<double>& smape) {
  using enum exact::DiffuseModel;
  const auto at = [](exact::DiffuseModel model) { return static_cast<size_t>(model); };
  const size_t hill = at(pettineo_hill), meder = at(meder_bruederlin), ours = at(tokuyoshi2022);
  const std::string place = "[SGL22] Fig. 4";
  const ModelTimes& times = full.times;
  const auto& black = full.splotches;
  return {
      {"Pettineo and Hill's method can produce black splotches", place, finding(black[hill] > 0),
       fmt::format("{} pixels", black[hill])},
      {"Meder and Brüderlin's method and the new one produce none", place,
       finding(black[meder] + black[ours] == 0), fmt::format("{} and {} pixels", black[meder], black[ours])},
      {"Pettineo and Hill's method is faster than both others", place,
       both(times.faster(pettineo_hill, meder_bruederlin), times.faster(pettineo_hill, tokuyoshi2022)),
       times.figures({pettineo_hill, meder_bruederlin, tokuyoshi2022})},
      {"the new method is slightly faster than Meder and Brüderlin's", place,
       times.faster(tokuyoshi2022, meder_bruederlin), times.figures({meder_bruederlin, tokuyoshi2022})},
      {"the new method is more accurate than Meder and Brüderlin's", place,
       finding(smape[ours] < smape[meder]),
       fmt::format("SMAPE {:.3g} % against {:.3g} %", smape[ours], smape[meder])}};
}

}  // namespace

FigureOutput lights(const FigureInputs& inputs) {
  const Json& c = inputs.config;
  inputs.begin("the loading of " + c["scene"].get<std::string>());
  const Scene scene = load_scene(c["scene"], {data_root() / "scenes", inputs.assets});
  KernelLibrary kernels(inputs.device);
  Stage stage(inputs.device, kernels, scene);
  const ModelImages images = small_images(stage, inputs);
  const Full full = full_frames(stage, inputs, splotch_of(c, images));
  require_light(images.reference);

  FigureOutput out;
  FigureTable table{
      "sgl22-4",
      {"model", "origin", "width", "height", "shade_ms_median", "shade_ms_q1", "shade_ms_q3", "shade_ms_lo95",
       "shade_ms_hi95", "repetitions", "black_pixels", "image_width", "image_height", "smape_percent"},
      {}};
  const Image& reference = images.reference;
  const std::string title = fmt::format("{}, {} VSGLs", scene.name, full.lights);
  const std::string size = fmt::format("{}×{}", c["width"].get<int>(), c["height"].get<int>());
  const std::string small = fmt::format("{}×{}", reference.width, reference.height);
  Plot plot{.title = title + ": time and error of the diffuse models",
            .x = {fmt::format("SMAPE against quadrature at {} / %", small), true},
            .y = {fmt::format("shade pass at {} / ms", size), false, true},
            .notes = {fmt::format("{}; medians of {} interleaved repetitions and their 95 % intervals. Both "
                                  "lobes, diffuse and specular.",
                                  inputs.device.info().name, c["repetitions"].dump())}};
  std::vector<double> smape;
  std::vector<std::string> more;
  for (size_t k = 0; k < kModels; ++k) {
    const Summary times = summarize(full.times.of(static_cast<exact::DiffuseModel>(k)));
    smape.push_back(measure_errors(images.images[k], reference, images.mask).smape);
    const std::string model = exact::diffuse_model_names()[k];
    // Times and black pixels are of width × height, the SMAPE is of image_width × image_height.
    table.add(model, std::string("measured"), c["width"].get<double>(), c["height"].get<double>(),
              times.median, times.q1, times.q3, times.ci95.lo, times.ci95.hi,
              static_cast<double>(times.samples.size()), static_cast<double>(full.splotches[k]),
              static_cast<double>(reference.width), static_cast<double>(reference.height), smape[k]);
    if (smape[k] > 0) {
      plot.curves.push_back({.name = model,
                             .points = {{smape[k], times.median}},
                             .style = CurveStyle::points,
                             .errors = {{{smape[k], times.ci95.lo}, {smape[k], times.ci95.hi}}}});
    }
    more.push_back(fmt::format("shade {:.3g} ms at {}", times.median, size));
  }
  out.tables = {table};
  out.plots = {{"sgl22-4", plot}};
  add_picture(&out, "sgl22-4", images, title, "diffuse integral by quadrature", more);
  out.claims = claims_of(full, smape);
  return out;
}

}  // namespace vsglbench::sgl22
