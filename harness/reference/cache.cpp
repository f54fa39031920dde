#include "reference/cache.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/file.h"
#include "base/hash.h"
#include "base/json.h"
#include "base/log.h"
#include "image/exr.h"
#include "image/labelled.h"
#include "image/noise_floor.h"

namespace vsglbench {
namespace {

std::filesystem::path cache_file(const std::string& hash, const char* extension) {
  return cache_directory() / "references" / (hash + extension);
}

std::vector<float> to_floats(const std::vector<uint8_t>& mask) { return {mask.begin(), mask.end()}; }

// Images first: the .json, written last, holds their hash and vouches for them.
std::string image_hash(const ReferenceResult& r) {
  Hasher hasher;
  for (const Image* image : {&r.mean, &r.variance, &r.half[0], &r.half[1]}) hasher.array(image->pixels);
  return hasher.array(r.mask).hex();
}

void store(const Scene& scene, const ReferenceResult& r, const ReferenceParameters& p) {
  ExrLayers layers;
  layers.width = r.mean.width;
  layers.height = r.mean.height;
  layers.colors = {{"", r.mean}, {"variance", r.variance}, {"half0", r.half[0]}, {"half1", r.half[1]}};
  layers.scalars = {{"mask", to_floats(r.mask)}};
  layers.attributes = {
      {"content",
       "indirect radiance, ray-traced reference; variance: of the mean; half0, half1: means of the even and "
       "of the odd batches; mask: 1 where the camera sees a surface"},
      {"units", radiance_labels().at("units")},
      {"scene", scene.name},
      {"sceneHash", scene.hash},
      {"seed", fmt::format("{}", p.seed)},
      {"samples", fmt::format("{}", r.samples)},
      {"reference_hash", r.hash}};
  write_exr(cache_file(r.hash, ".exr"), layers);
  const Json meta = {{"hash", r.hash},
                     {"images", image_hash(r)},
                     {"width", p.width},
                     {"height", p.height},
                     {"occlusion", p.occlusion},
                     {"seed", p.seed},
                     {"samples", r.samples},
                     {"batches", r.batches},
                     {"photons", r.photons},
                     {"rays", r.rays},
                     {"seconds", r.seconds},
                     {"noise_floor_smape", r.noise_floor_smape},
                     {"standard_error", r.standard_error},
                     {"ended_by", static_cast<int>(r.ended_by)}};
  write_text(cache_file(r.hash, ".json"), meta.dump(1) + "\n");
}

ReferenceResult parse(const std::string& hash) {
  const auto document = JsonDocument::load(cache_file(hash, ".json"), ErrorKind::output);
  const Json& meta = document.root();
  const ExrLayers layers = read_exr_layers(cache_file(hash, ".exr"));
  ReferenceResult r;
  r.mean = layers.colors.at("");
  r.variance = layers.colors.at("variance");
  r.half[0] = layers.colors.at("half0");
  r.half[1] = layers.colors.at("half1");
  const std::vector<float>& mask = layers.scalars.at("mask");
  r.mask.assign(mask.begin(), mask.end());
  r.hash = meta.at("hash");
  r.samples = meta.at("samples");
  r.batches = meta.at("batches");
  r.photons = meta.at("photons");
  r.rays = meta.at("rays");
  r.seconds = meta.at("seconds");
  r.noise_floor_smape = noise_floor_of(r.half[0], r.half[1], r.mean, r.mask).smape;
  r.standard_error = meta.at("standard_error");
  r.ended_by = static_cast<ReferenceEnd>(std::clamp<int>(meta.at("ended_by"), 0, 2));
  if (r.hash != hash || meta.at("images") != image_hash(r)) {
    throw fail(ErrorKind::output, "its content isn't what its .json says");
  }
  return r;
}

}  // namespace

std::optional<ReferenceResult> cached_reference(const std::string& hash, const ReferenceParameters& p) {
  std::error_code ignored;
  if (!std::filesystem::exists(cache_file(hash, ".json"), ignored)) return std::nullopt;
  try {
    ReferenceResult r = parse(hash);
    if (r.mean.width == p.width && r.mean.height == p.height) return r;
    log_warning("{}: of another size than its name says; computing the reference anew",
                cache_file(hash, ".exr").string());
  } catch (const std::exception& e) {
    log_warning("cached reference {} is damaged ({}); computing it anew", hash, e.what());
  }
  return std::nullopt;
}

ReferenceResult load_or_compute(const Scene& scene, const ReferenceParameters& parameters, bool* from_cache) {
  return load_or_compute(
      scene, reference_hash(scene, parameters), parameters,
      [&] { return compute_reference(scene, parameters); }, from_cache);
}

ReferenceResult load_or_compute(const Scene& scene, const std::string& hash,
                                const ReferenceParameters& parameters,
                                const std::function<ReferenceResult()>& compute, bool* from_cache) {
  auto cached = cached_reference(hash, parameters);
  if (from_cache) *from_cache = cached.has_value();
  if (cached) return *std::move(cached);
  ReferenceResult fresh = compute();
  try {
    store(scene, fresh, parameters);
  } catch (const std::exception& e) {
    log_warning("the reference of {} can't be cached: {}", scene.name, e.what());
  }
  return fresh;
}

}  // namespace vsglbench
