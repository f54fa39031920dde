#include "run/references.h"

#include <algorithm>
#include <numbers>

#include "base/log.h"
#include "base/progress.h"
#include "image/noise_floor.h"
#include "measure/stopwatch.h"
#include "reference/cache.h"
#include "run/memory.h"
#include "scene/view.h"

namespace vsglbench {

namespace {

constexpr double kMostError = 0.5;  // of a mean that says something, relative

// m².
double surface_area(const Scene& scene) {
  double area = 0;
  for (const glm::uvec3& t : scene.triangles) {
    const glm::dvec3 a = scene.positions[t.x];
    area += 0.5 * glm::length(
                      glm::cross(glm::dvec3(scene.positions[t.y]) - a, glm::dvec3(scene.positions[t.z]) - a));
  }
  return area;
}

double luminance64(const glm::dvec3& c) { return glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722)); }

void describe_light(const Scene& scene, const ReferenceResult& r, ReferenceInfo* info) {
  double sum = 0, pixels = 0, black = 0;
  for (size_t i = 0; i < r.mean.pixels.size(); ++i) {
    if (!r.mask[i]) continue;
    ++pixels;
    sum += luminance64(r.mean.pixels[i]);
    black += r.mean.pixels[i] == glm::vec3(0);
  }
  const double flux = luminance64(frustum_flux(scene.light));
  if (flux > 0) info->light_ratio = std::numbers::pi * surface_area(scene) * (sum / pixels) / flux;
  info->black_share = black / pixels;
}

ReferenceInfo describe(const Scene& scene, const ReferenceResult& r) {
  ReferenceInfo info;
  info.hash = r.hash;
  info.samples = r.samples;
  const NoiseFloor floor = noise_floor_of(r.half[0], r.half[1], r.mean, r.mask);
  info.noise_floor_smape = floor.smape;
  info.noise_floor_rmse = floor.rmse;
  info.noise_floor_smape_lit = floor.smape_lit;
  info.noise_floor_rrmse = floor.rrmse;
  info.noise_floor_mrse = floor.mrse;
  info.noise_floor_flip = flip_floor_of(r.half[0], r.half[1], r.mean, r.mask);
  info.batches = r.batches;
  info.standard_error = r.standard_error;
  info.ended_by = std::string(name(r.ended_by));
  describe_light(scene, r, &info);
  return info;
}

}  // namespace

std::optional<std::string> doubt_about(const Scene& scene, const ReferenceResult& r) {
  if (std::ranges::all_of(r.mean.pixels, [](const glm::vec3& v) { return v == glm::vec3(0); }))
    throw fail(ErrorKind::case_failed, "{}: no indirect light reaches the view: the reference is black",
               scene.name);
  ReferenceInfo info;
  describe_light(scene, r, &info);
  if (info.light_ratio && *info.light_ratio < kNearlyBlack) {
    return fmt::format(
        "the reference is nearly black: its mean is {:.2g} of what the light's flux could give; another view "
        "or light would tell more",
        *info.light_ratio);
  }
  if (r.standard_error > kMostError) {
    return fmt::format(
        "hardly any light reaches the view: the reference's mean is known to {:.0f} % only; more samples, or "
        "another view or light, would tell more",
        100 * r.standard_error);
  }
  return std::nullopt;
}

std::string end_of_search(const ReferenceResult& result, const ReferenceParameters& p) {
  if (p.floor == 0) return "";
  return fmt::format(", {} {} %", result.ended_by == ReferenceEnd::floor ? "reached" : "ended before",
                     p.floor) +
         (result.ended_by == ReferenceEnd::time_limit ? fmt::format(" by the limit of {} s", p.time_limit)
                                                      : "");
}

std::string rounding_of(const ReferenceResult& result, const ReferenceParameters& p) {
  if (p.floor > 0 || result.samples == p.samples) return "";
  return fmt::format(" ({} asked for, rounded up to {} equal batches)", p.samples, result.batches);
}

const ReferenceResult& References::get(const Case& c) { return *slot(c).result; }
const ReferenceInfo& References::info(const Case& c) { return *slot(c).info; }

References::Slot& References::slot(const Case& c) {
  const bool occlusion = c.frame.visibility != Visibility::none;
  Slot& slot = slots_[{c.frame.width, c.frame.height, occlusion}];
  if (!slot.result && !slot.error) {
    const Stopwatch watch;
    try {
      slot.result = std::make_unique<ReferenceResult>(obtain(c));
      slot.info = describe(scene_, *slot.result);
    } catch (const Error& e) {
      slot.error = e;
    }
    wall_->references_s += watch.seconds();
  }
  if (slot.error) throw *slot.error;
  return slot;
}

ReferenceParameters reference_parameters(const Config& config, const Case& c) {
  ReferenceParameters p;
  p.width = c.frame.width;
  p.height = c.frame.height;
  p.samples = config.reference.samples;
  p.batches = config.reference.batches;
  p.seed = config.reference.seed;
  p.shading_normals = config.reference.shading_normals;
  p.floor = config.reference.floor;
  if (p.floor > 0) p.time_limit = config.reference.time_limit_s;
  p.occlusion = c.frame.visibility != Visibility::none;
  return p;
}

ReferenceResult References::obtain(const Case& c) {
  require_reference_memory(c.frame.width, c.frame.height);
  const ReferenceParameters p = reference_parameters(config_, c);
  const Stopwatch watch;
  bool cached = false;
  ReferenceResult result = load_or_compute(scene_, p, &cached);
  if (const auto doubt = doubt_about(scene_, result)) log_warning("{}: {}", scene_.name, *doubt);
  log_info(
      "{}: reference{} of {} samples{} {} ({}), noise floor {:.2f} % SMAPE, its mean known to {:.2f} %{}",
      scene_.name, p.occlusion ? "" : " without occlusion", result.samples, rounding_of(result, p),
      cached ? "from the cache" : "computed", format_duration(watch.seconds()), result.noise_floor_smape,
      100 * result.standard_error, end_of_search(result, p));
  return result;
}

}  // namespace vsglbench
