#include "lights/edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vsglbench {
namespace {

using glm::dvec3;

// World area of the texel at (x, y), as shaders/field.glsl has it.
double texel_area(const gpu::Emitter& e, uint32_t x, uint32_t y, const dvec3& position, const dvec3& normal) {
  const double area = 4.0 * e.extent.x * e.extent.y / (double(e.width) * e.height);
  dvec3 view = -dvec3(e.forward);
  double across = area;  // of the beam, where it meets the surface
  if (e.perspective) {
    const dvec3 to_emitter = dvec3(e.position) - position;
    const double px = (2 * (x + 0.5) / e.width - 1) * e.extent.x,
                 py = (1 - 2 * (y + 0.5) / e.height) * e.extent.y;
    across *= std::pow(1 + px * px + py * py, -1.5) * glm::dot(to_emitter, to_emitter);
    view = glm::normalize(to_emitter);
  }
  return across / std::max(glm::dot(normal, view), double(e.footprint_cosine));
}

// Counts over rectangles of texels, each from four sums.
class Counts {
 public:
  template <class Value>
  Counts(uint32_t width, uint32_t height, const Value& value)
      : width_(width + 1), sums_(size_t(width + 1) * (height + 1), 0) {
    for (uint32_t y = 0; y < height; ++y) {
      for (uint32_t x = 0; x < width; ++x)
        at(x + 1, y + 1) = at(x, y + 1) + at(x + 1, y) - at(x, y) + (value(x, y) ? 1 : 0);
    }
  }
  // In [from, to), which may be empty.
  uint64_t operator()(glm::uvec2 from, glm::uvec2 to) const {
    if (from.x >= to.x || from.y >= to.y) return 0;
    return at(to.x, to.y) + at(from.x, from.y) - at(from.x, to.y) - at(to.x, from.y);
  }

 private:
  uint64_t& at(uint32_t x, uint32_t y) { return sums_[size_t(y) * width_ + x]; }
  uint64_t at(uint32_t x, uint32_t y) const { return sums_[size_t(y) * width_ + x]; }
  uint32_t width_;
  std::vector<uint64_t> sums_;
};

// Pairs of a texel and the next one at `step` from it, counted at the first.
struct Pairs {
  Pairs(const TexelSurfaces& half, glm::uvec2 step_to_next)
      : step(step_to_next),
        all(half.width - step.x, half.height - step.y,
            [&](uint32_t x, uint32_t y) {
              const size_t a = index(half, x, y), b = index(half, x + step.x, y + step.y);
              return half.positions[a].w > 0 || half.positions[b].w > 0;
            }),
        edges(half.width - step.x, half.height - step.y, [&](uint32_t x, uint32_t y) {
          return is_edge(half, index(half, x, y), index(half, x + step.x, y + step.y));
        }) {}
  static size_t index(const TexelSurfaces& half, uint32_t x, uint32_t y) {
    return size_t(y) * half.width + x;
  }
  glm::uvec2 step;
  Counts all, edges;
};

double median_size(const TexelSurfaces& half, glm::uvec2 from, glm::uvec2 to) {
  std::vector<double> sizes;
  for (uint32_t y = from.y; y < to.y; ++y) {
    for (uint32_t x = from.x; x < to.x; ++x) {
      const double size = half.sizes[size_t(y) * half.width + x];
      if (size > 0) sizes.push_back(size);
    }
  }
  return sizes.empty() ? 0 : median(sizes);
}

}  // namespace

TexelSurfaces surfaces_of(const gpu::Emitter& emitter, std::vector<glm::vec4> positions,
                          std::vector<glm::vec4> normals) {
  TexelSurfaces half{emitter.width, emitter.height, std::move(positions), std::move(normals), {}};
  for (uint32_t y = 0; y < half.height; ++y) {
    for (uint32_t x = 0; x < half.width; ++x) {
      const size_t i = size_t(y) * half.width + x;
      const glm::vec4& p = half.positions[i];
      half.sizes.push_back(p.w > 0 ? std::sqrt(texel_area(emitter, x, y, dvec3(p), dvec3(half.normals[i])))
                                   : 0);
    }
  }
  return half;
}

bool is_edge(const TexelSurfaces& half, size_t a, size_t b) {
  const bool first = half.positions[a].w > 0, second = half.positions[b].w > 0;
  if (!first || !second) return first != second;
  const dvec3 na(half.normals[a]), nb(half.normals[b]);
  if (glm::dot(na, nb) < 0.5) return true;
  const dvec3 apart = dvec3(half.positions[b]) - dvec3(half.positions[a]);
  const double off_plane = std::max(std::abs(glm::dot(apart, na)), std::abs(glm::dot(apart, nb)));
  return off_plane > 2 * std::max(half.sizes[a], half.sizes[b]);
}

std::vector<FootprintEdges> footprint_edges(const TexelSurfaces& half,
                                            const std::vector<glm::vec4>& squares) {
  const Pairs rows(half, {1, 0}), columns(half, {0, 1});
  const glm::dvec2 size(half.width, half.height);
  std::vector<FootprintEdges> out;
  for (const glm::vec4& square : squares) {
    FootprintEdges edges;
    if (square.z > 0) {
      const glm::dvec2 centre(square), reach(0.5 * square.z);
      const glm::uvec2 from(glm::clamp(glm::floor(centre - reach), glm::dvec2(0), size)),
          to(glm::clamp(glm::ceil(centre + reach), glm::dvec2(0), size));
      uint64_t all = 0, broken = 0;
      for (const Pairs* pairs : {&rows, &columns}) {  // the last texel's next one is outside
        const glm::uvec2 end = to - glm::min(pairs->step, to);
        all += pairs->all(from, end);
        broken += pairs->edges(from, end);
      }
      if (all > 0) edges.share = static_cast<double>(broken) / static_cast<double>(all);
      edges.texel = median_size(half, from, to);
    }
    out.push_back(edges);
  }
  return out;
}

EdgeEffect edge_effect(const LightRecords& lights, const std::vector<glm::vec4>& squares,
                       const std::vector<FootprintEdges>& edges) {
  struct Group {
    std::vector<double> sigma, density;
  } on, off;
  const std::vector<LightSummary> all = summaries_of(lights);
  for (size_t i = 0; i < std::min({all.size(), squares.size(), edges.size()}); ++i) {
    const double variance = all[i].variance, power = all[i].power;
    if (!(power > 0 && variance > 0 && squares[i].z >= 2 && edges[i].texel > 0)) continue;
    Group& group = edges[i].share > EdgeEffect::kOnEdge ? on : off;
    group.sigma.push_back(std::sqrt(variance) / (squares[i].z * edges[i].texel));
    group.density.push_back(power / (2 * std::numbers::pi * variance));
  }
  EdgeEffect effect{.on = on.sigma.size(), .off = off.sigma.size()};
  if (effect.on < EdgeEffect::kLeast || effect.off < EdgeEffect::kLeast) return effect;
  effect.sigma = median_ratio(on.sigma, off.sigma);
  effect.density = median_ratio(on.density, off.density);
  return effect;
}

Json to_json(const EdgeEffect& effect) {
  Json json = {{"lights_on", effect.on}, {"lights_off", effect.off}};
  const auto add = [&](const std::string& key, const std::optional<Ratio>& ratio) {
    if (ratio) json.update({{key, ratio->value}, {key + "_ci95", {ratio->ci95.lo, ratio->ci95.hi}}});
  };
  add("sigma_ratio", effect.sigma);
  add("density_ratio", effect.density);
  return json;
}

EdgeEffect edge_effect_from(const Json& json) {
  const auto ratio = [&](const std::string& key) -> std::optional<Ratio> {
    if (!json.contains(key)) return std::nullopt;
    const Json& ci95 = json.at(key + "_ci95");
    return Ratio{json.at(key), {ci95.at(0), ci95.at(1)}};
  };
  return {json.at("lights_on"), json.at("lights_off"), ratio("sigma_ratio"), ratio("density_ratio")};
}

}  // namespace vsglbench
