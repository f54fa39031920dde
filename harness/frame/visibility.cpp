#include "frame/visibility.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <numeric>
#include <random>

#include "base/error.h"
#include "base/file.h"
#include "base/nearest.h"
#include "gpu/limits.h"

namespace vsglbench {

const std::vector<std::string>& visibility_names() {
  static const std::vector<std::string> names = {"none", "exact", "ism", "aism", "tism"};
  return names;
}

std::string visibility_name(Visibility v) { return visibility_names()[static_cast<size_t>(v)]; }

Visibility parse_visibility(const std::string& name) {
  const auto& names = visibility_names();
  const auto it = std::find(names.begin(), names.end(), name);
  if (it != names.end()) return static_cast<Visibility>(it - names.begin());
  throw fail(ErrorKind::config, "no visibility '{}'{}", name, suggestion(name, names));
}

namespace {

// A unit vector or its opposite, octahedral, as two 16-bit signed fractions (packSnorm2x16).
uint32_t pack_normal(glm::dvec3 n) {
  n *= (n.z < 0 ? -1 : 1) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
  const auto fraction = [](double v) {
    return static_cast<uint16_t>(static_cast<int16_t>(std::lround(v * 32767)));
  };
  return fraction(n.x) | static_cast<uint32_t>(fraction(n.y)) << 16;
}

struct SurfacePoint {
  glm::vec3 position;
  uint32_t normal;
};
static_assert(sizeof(SurfacePoint) == 16);

// `count` points spread uniformly over the scene's area.
std::vector<SurfacePoint> surface_points(const Scene& scene, uint32_t count) {
  std::vector<double> cumulative(scene.triangles.size());
  double total = 0;
  for (size_t i = 0; i < cumulative.size(); ++i) {
    const auto& t = scene.triangles[i];
    const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
    cumulative[i] = total += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  std::mt19937_64 random(1);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<SurfacePoint> points(count);
  for (auto& point : points) {
    const auto it = std::upper_bound(cumulative.begin(), cumulative.end(), uniform() * total);
    const size_t i = std::min<size_t>(it - cumulative.begin(), cumulative.size() - 1);
    const double s = std::sqrt(uniform()), v = uniform();
    const auto& t = scene.triangles[i];
    const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
    point = {glm::vec3((1 - s) * a + s * (1 - v) * b + s * v * c),
             pack_normal(glm::normalize(glm::cross(b - a, c - a)))};
  }
  return points;
}

constexpr uint32_t kPool = 1u << 20;  // points of ism, from which each map takes its share
constexpr uint32_t kCoarsest = 4;     // holes are filled down to 4×4: a wider one is open space
constexpr size_t kFrameBytes = 2 * sizeof(glm::vec4);

std::filesystem::path shader(const char* file) { return data_root() / "harness" / "frame" / file; }

}  // namespace

ImperfectShadowMaps::ImperfectShadowMaps(KernelLibrary& kernels, ShadowMapMemory& memory, const Scene& scene,
                                         Visibility technique, IsmParameters parameters)
    : kernels_(kernels),
      memory_(memory),
      technique_(technique),
      parameters_(parameters),
      tolerance_(kVisibilityTolerance * scene.diagonal()) {
  if (technique_ == Visibility::ism) {
    const auto points = surface_points(scene, kPool);
    points_ = Buffer(kernels.device(), "ism points", points.size() * sizeof(SurfacePoint));
    points_.upload(std::span<const SurfacePoint>(points));
  } else {
    surface_ = SurfaceClustersGpu(kernels.device(), cluster_surface(scene));
  }
}

size_t ImperfectShadowMaps::level_bytes(uint32_t size, uint32_t count) const {
  return size_t(count) * size * size * sizeof(uint32_t);
}

Buffer& ImperfectShadowMaps::level(uint32_t size, uint32_t count) {
  return memory_.levels[size].get(kernels_.device(), fmt::format("ism {}", size), level_bytes(size, count));
}

size_t ImperfectShadowMaps::memory_bytes(uint32_t count) const {
  size_t bytes =
      count * kFrameBytes + points_.size() + surface_.bytes() + level_bytes(parameters_.size, count);
  for (uint32_t size = parameters_.size / 2; size >= kCoarsest; size /= 2) bytes += level_bytes(size, count);
  return bytes;
}

PassId ImperfectShadowMaps::pass(const char* step) const {
  return {PassStage::visibility, std::nullopt, fmt::format("{}.{}", visibility_name(technique_), step)};
}

ImperfectShadowMaps::Maps ImperfectShadowMaps::build(Recorder& recorder, const Buffer& lights, LightKind kind,
                                                     uint32_t count, const DeferredTargets& seen,
                                                     bool clears_sigma, unsigned lobes) {
  Buffer& frames = memory_.frames.get(kernels_.device(), "ism frames", count * kFrameBytes);
  Buffer& maps = level(parameters_.size, count);
  ShaderDefines defines = info_of(kind).record_defines;
  defines["LIGHT_CLEARANCE"] = clears_sigma ? "1" : "0";
  if (lobes != (DIFFUSE_LOBE | SPECULAR_LOBE)) defines["LIGHT_LOBES"] = std::to_string(lobes);
  const Kernel& make_frames = kernels_.get(shader("ism_frames.comp"), defines);
  const struct {
    uint32_t count;
    float tolerance;
  } push{count, tolerance_};
  recorder.pass(pass("splat"), [&] {
    recorder.fill(maps, 0x7F800000u);
    recorder.dispatch(make_frames, {lights, frames}, push, groups_for(count, 64));
    recorder.barrier();
    splat(recorder, frames, maps, count, seen);
  });
  fill_holes(recorder, count);
  return {&maps, &frames, parameters_.size, tolerance_};
}

void ImperfectShadowMaps::splat(Recorder& recorder, const Buffer& frames, const Buffer& maps, uint32_t count,
                                const DeferredTargets& seen) {
  const auto& [size, points] = parameters_;
  const auto& [positions, triangles, areas, clusters, cluster_count] = surface_;
  if (technique_ == Visibility::ism) {
    const struct { uint32_t count, map_size, per_map, pool; } push{count, size, points, kPool};
    recorder.dispatch(kernels_.get(shader("ism_splat.comp")), {frames, points_, maps}, push,
                      groups_for(points, 64), count);
  } else if (technique_ == Visibility::aism) {
    const struct {
      uint32_t count, map_size, per_map, cluster_count, width, height;
    } push{count, size, points, cluster_count, seen.width, seen.height};
    recorder.dispatch(kernels_.get(shader("aism_splat.comp")),
                      {positions, triangles, areas, clusters, frames, maps, *seen.field_maps().position},
                      push, count);
  } else {
    const struct {
      uint32_t count, map_size, cluster_count;
      float piece;
    } push{count, size, cluster_count, 2 * glm::pi<float>() / static_cast<float>(points)};
    recorder.dispatch(kernels_.get(shader("tism_splat.comp"),
                                   {{"MOST_ROUNDS", fmt::format("{}u", limits::quarter_of_rounds)}}),
                      {positions, triangles, areas, clusters, frames, maps}, push,
                      groups_for(cluster_count, 64), count);
  }
}

void ImperfectShadowMaps::fill_holes(Recorder& recorder, uint32_t count) {
  const Kernel& pull = kernels_.get(shader("ism_pull.comp"));
  const Kernel& push_kernel = kernels_.get(shader("ism_push.comp"));
  recorder.pass(pass("pull"), [&] {
    for (uint32_t size = parameters_.size / 2; size >= kCoarsest; size /= 2) {
      recorder.dispatch(pull, {level(2 * size, count), level(size, count)}, size, groups_for(size * size, 64),
                        count);
      recorder.barrier();
    }
  });
  recorder.pass(pass("push"), [&] {
    for (uint32_t size = 2 * kCoarsest; size <= parameters_.size; size *= 2) {
      recorder.dispatch(push_kernel, {level(size / 2, count), level(size, count)}, size,
                        groups_for(size * size, 64), count);
      recorder.barrier();
    }
  });
}

}  // namespace vsglbench
