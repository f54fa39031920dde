#include "frame/visibility.h"

#include <algorithm>
#include <numeric>
#include <random>

#include "base/error.h"
#include "base/file.h"
#include "base/nearest.h"

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

// `count` points spread uniformly over the scene's area.
std::vector<glm::vec4> surface_points(const Scene& scene, uint32_t count) {
  std::vector<double> cumulative(scene.triangles.size());
  double total = 0;
  for (size_t i = 0; i < cumulative.size(); ++i) {
    const auto& t = scene.triangles[i];
    const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
    cumulative[i] = total += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  std::mt19937_64 random(1);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<glm::vec4> points(count);
  for (auto& point : points) {
    const auto it = std::upper_bound(cumulative.begin(), cumulative.end(), uniform() * total);
    const size_t i = std::min<size_t>(it - cumulative.begin(), cumulative.size() - 1);
    const double s = std::sqrt(uniform()), v = uniform();
    const auto& t = scene.triangles[i];
    const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
    point = glm::vec4(glm::vec3((1 - s) * a + s * (1 - v) * b + s * v * c), 1);
  }
  return points;
}

}  // namespace

ImperfectShadowMaps::ImperfectShadowMaps(KernelLibrary& kernels, ScratchPool& scratch, const Scene& scene,
                                         Visibility technique, IsmParameters parameters)
    : kernels_(kernels),
      scratch_(scratch),
      technique_(technique),
      parameters_(parameters),
      pool_(1u << 20) {
  const auto points = surface_points(scene, pool_);
  points_ = Buffer(kernels.device(), "ism points", points.size() * sizeof(glm::vec4));
  points_.upload(std::span<const glm::vec4>(points));
}

Buffer& ImperfectShadowMaps::level(uint32_t size, uint32_t count) {
  return scratch_.get(fmt::format("ism {}", size), size_t(count) * size * size * sizeof(uint32_t));
}

ImperfectShadowMaps::Maps ImperfectShadowMaps::build(Recorder& recorder, const Buffer& lights, LightKind kind,
                                                     uint32_t count, const DeferredTargets& /*seen*/) {
  const auto folder = data_root() / "harness" / "frame";
  const uint32_t size = parameters_.size;
  Buffer& frames = scratch_.get("ism frames", size_t(count) * 32);
  Buffer& maps = level(size, count);
  const Kernel& make_frames =
      kernels_.get(folder / "ism_frames.comp", {{"LIGHT_VPL", kind == LightKind::vsgl ? "0" : "1"}});
  const Kernel& splat = kernels_.get(folder / "ism_splat.comp");
  recorder.pass("visibility.ism.splat", [&] {
    recorder.fill(maps, 0x7F800000u);
    recorder.dispatch(make_frames, {lights, frames}, count, groups_for(count, 64));
    recorder.barrier();
    const struct { uint32_t count, map_size, per_map, pool; } push{count, size, parameters_.points, pool_};
    recorder.dispatch(splat, {frames, points_, maps}, push, groups_for(parameters_.points, 64), count);
  });
  fill_holes(recorder, count);
  return {&maps, &frames, size};
}

void ImperfectShadowMaps::fill_holes(Recorder& recorder, uint32_t count) {
  const auto folder = data_root() / "harness" / "frame";
  const Kernel& pull = kernels_.get(folder / "ism_pull.comp");
  const Kernel& push_kernel = kernels_.get(folder / "ism_push.comp");
  // Down to 4×4: a wider hole is open space.
  constexpr uint32_t coarsest = 4;
  recorder.pass("visibility.ism.pull", [&] {
    for (uint32_t size = parameters_.size / 2; size >= coarsest; size /= 2) {
      recorder.dispatch(pull, {level(2 * size, count), level(size, count)}, size, groups_for(size * size, 64),
                        count);
      recorder.barrier();
    }
  });
  recorder.pass("visibility.ism.push", [&] {
    for (uint32_t size = 2 * coarsest; size <= parameters_.size; size *= 2) {
      recorder.dispatch(push_kernel, {level(size / 2, count), level(size, count)}, size,
                        groups_for(size * size, 64), count);
      recorder.barrier();
    }
  });
}

}  // namespace vsglbench
