#include "lights/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.h"

namespace vsglbench {
namespace {

// How often each texel of an image is counted, from rectangles of texels that each add an amount:
// differences, summed up once.
class Counts {
 public:
  Counts(uint32_t width, uint32_t height)
      : width_(width), height_(height), steps_((size_t(width) + 1) * (size_t(height) + 1), 0) {}
  void add(glm::uvec2 from, glm::uvec2 to, double amount) {
    step(from.x, from.y) += amount;
    step(to.x, from.y) -= amount;
    step(from.x, to.y) -= amount;
    step(to.x, to.y) += amount;
  }
  std::vector<double> texels() const {
    std::vector<double> out(size_t(width_) * height_), above(width_, 0);
    for (uint32_t y = 0; y < height_; ++y) {
      double row = 0;
      for (uint32_t x = 0; x < width_; ++x) {
        row += steps_[size_t(y) * (width_ + 1) + x];
        above[x] += row;
        out[size_t(y) * width_ + x] = above[x];
      }
    }
    return out;
  }

 private:
  double& step(uint32_t x, uint32_t y) { return steps_[size_t(y) * (width_ + 1) + x]; }
  uint32_t width_, height_;
  std::vector<double> steps_;
};

// A texel of a level, on one axis: the base texels [from, to) of its block, and its weight.
struct Tap {
  uint32_t texel, from, to;
  double weight;
};

// The two that bilinear filtering at `position` reads on one axis of a level (shaders/pyramid.glsl).
std::array<Tap, 2> taps(uint32_t base, uint32_t level, double position) {
  const uint32_t block = 1u << level, size = (base + block - 1) / block;
  const double centre = std::clamp(position / block - 0.5, 0.0, size - 1.0);
  const auto lower = static_cast<uint32_t>(centre);
  const uint32_t upper = std::min(lower + 1, size - 1);
  const double part = std::min(1.0, static_cast<double>(base) / block - upper);
  double f = centre - lower;
  if (part < 0.5) f *= 2 * part / ((0.5 + part) * (0.5 + part));
  const auto tap = [&](uint32_t texel, double weight) {
    return Tap{texel, texel * block, std::min(base, (texel + 1) * block), weight};
  };
  return {tap(lower, 1 - f), tap(upper, f)};
}

uint32_t top_level(uint32_t width, uint32_t height) {
  uint32_t top = 0;
  while ((uint64_t{1} << top) < std::max(width, height)) ++top;
  return top;
}

// What a footprint reads of an image: each(level, x, y, weight) for the texels of its two levels, whose
// blocks' base texels weigh `weight` each. In all that is 4^l, l being its level.
template <class Each>
void each_tap(const glm::vec4& footprint, uint32_t width, uint32_t height, const Each& each) {
  if (!(footprint.z > 0)) return;
  const uint32_t top = top_level(width, height);
  const double level = std::clamp(std::log2(double(footprint.z)), 0.0, double(top)),
               area = std::exp2(2 * level);
  const auto lower = static_cast<uint32_t>(level);
  const std::pair<uint32_t, double> parts[] = {{lower, area * (1 - (level - lower))},
                                               {std::min(lower + 1, top), area * (level - lower)}};
  for (const auto& [l, times] : parts) {
    for (const Tap& y : taps(height, l, footprint.y)) {
      for (const Tap& x : taps(width, l, footprint.x)) {
        const double texels = double(x.to - x.from) * (y.to - y.from);
        each(l, x, y, times * x.weight * y.weight / texels);
      }
    }
  }
}

// The PDF's sums over the blocks of every level: each adds up four of the level below.
class BlockSums {
 public:
  BlockSums(uint32_t width, uint32_t height, const std::vector<float>& pdf) : width_(width) {
    levels_.emplace_back(pdf.begin(), pdf.end());
    for (uint32_t level = 1; level <= top_level(width, height); ++level) {
      const uint32_t below_w = size(width, level - 1), below_h = size(height, level - 1);
      std::vector<double> sums(size_t(size(width, level)) * size(height, level), 0);
      for (uint32_t y = 0; y < below_h; ++y) {
        for (uint32_t x = 0; x < below_w; ++x)
          sums[size_t(y / 2) * size(width, level) + x / 2] += levels_.back()[size_t(y) * below_w + x];
      }
      levels_.push_back(std::move(sums));
    }
  }
  double at(uint32_t level, uint32_t x, uint32_t y) const {
    return levels_[level][size_t(y) * size(width_, level) + x];
  }
  double all() const { return levels_.back().front(); }

 private:
  static uint32_t size(uint32_t base, uint32_t level) { return (base + (1u << level) - 1) >> level; }
  uint32_t width_;
  std::vector<std::vector<double>> levels_;
};

struct Integrals {
  double all = 0, overlap = 0, gap = 0;
  void add(double amount, double count) {
    all += amount;
    overlap += std::max(count - 1, 0.0) * amount;
    gap += std::max(1 - count, 0.0) * amount;
  }
};

Coverage means(const Integrals& area, const Integrals& pdf) {
  Coverage c{area.overlap / area.all, area.gap / area.all, std::nullopt, std::nullopt};
  if (pdf.all > 0) {
    c.pdf_overlap = pdf.overlap / pdf.all;
    c.pdf_gap = pdf.gap / pdf.all;
  }
  return c;
}

glm::vec4 checked(const glm::vec4& square, size_t light) {
  if (std::isfinite(square.x) && std::isfinite(square.y) && std::isfinite(square.z) && square.z >= 0)
    return square;
  throw fail(ErrorKind::plugin, "the footprint of light {} is no square: centre ({}, {}), side {}", light,
             square.x, square.y, square.z);
}

template <class T>
std::vector<T> read(const Buffer& buffer, uint64_t count) {
  if (buffer.size() >= count * sizeof(T)) return buffer.download<T>(count);
  throw fail(ErrorKind::plugin, "the method's light shapes have {} bytes for {} records of {}", buffer.size(),
             count, sizeof(T));
}

std::vector<uint32_t> read_clusters(const LightShapes& shapes, uint32_t lights, uint64_t texels) {
  const auto ids = read<uint32_t>(*shapes.ids, texels);
  if (!shapes.texels) return ids;
  const auto places = read<uint32_t>(*shapes.texels, texels);
  std::vector<uint32_t> clusters(texels, lights);
  for (size_t i = 0; i < texels; ++i) {
    if (places[i] >= texels)
      throw fail(ErrorKind::plugin, "cluster {} has texel {}, outside of the RSM", ids[i], places[i]);
    clusters[places[i]] = ids[i];
  }
  return clusters;
}

}  // namespace

RsmShapes read_shapes(const LightShapes& shapes, uint32_t lights, uint64_t texels) {
  RsmShapes out;
  if (shapes.squares) {
    out.squares = read<glm::vec4>(*shapes.squares, lights);
    for (size_t i = 0; i < out.squares.size(); ++i) checked(out.squares[i], i);
  } else if (shapes.ids) {
    out.clusters = read_clusters(shapes, lights, texels);
  }
  return out;
}

Coverage cover_footprints(const std::vector<glm::vec4>& footprints, uint32_t width, uint32_t height,
                          const std::vector<float>& pdf) {
  Counts counts(width, height);
  for (const glm::vec4& footprint : footprints) {
    each_tap(footprint, width, height, [&](uint32_t, const Tap& x, const Tap& y, double weight) {
      counts.add({x.from, y.from}, {x.to, y.to}, weight);
    });
  }
  Integrals all, weighted;
  const std::vector<double> count = counts.texels();
  for (size_t i = 0; i < count.size(); ++i) {
    all.add(1, count[i]);
    if (!pdf.empty()) weighted.add(pdf[i], count[i]);
  }
  return means(all, weighted);
}

std::vector<double> kernel_masses(const std::vector<glm::vec4>& footprints, uint32_t width, uint32_t height,
                                  const std::vector<float>& pdf) {
  if (pdf.empty()) return {};
  const BlockSums sums(width, height, pdf);
  if (!(sums.all() > 0)) return {};
  std::vector<double> masses;
  for (const glm::vec4& footprint : footprints) {
    double held = 0;
    each_tap(footprint, width, height, [&](uint32_t level, const Tap& x, const Tap& y, double weight) {
      held += weight * sums.at(level, x.texel, y.texel);
    });
    masses.push_back(double(footprints.size()) * held / sums.all());
  }
  return masses;
}

std::optional<KernelStats> kernel_stats(const std::vector<glm::vec4>& footprints,
                                        const std::vector<double>& masses) {
  KernelStats stats;
  size_t kernels = 0, powered = 0;
  for (size_t i = 0; i < masses.size(); ++i) {
    if (!(footprints[i].z > 0)) continue;
    ++kernels;
    stats.largest = std::max(stats.largest, masses[i]);
    stats.mean += masses[i];
    stats.over += masses[i] > kTooLargeKernel;
    if (!(masses[i] > 0)) continue;  // one that holds nothing is not drawn by this PDF
    ++powered;
    stats.spread += std::abs(std::log2(masses[i]));
  }
  if (kernels == 0) return std::nullopt;
  stats.mean /= double(kernels);
  stats.over /= double(kernels);
  if (powered > 0) stats.spread /= double(powered);
  return stats;
}

std::optional<KernelStats> kernels_of(const RsmShapes& shapes, uint32_t width, uint32_t height,
                                      const std::vector<float>& pdf) {
  return kernel_stats(shapes.squares, kernel_masses(shapes.squares, width, height, pdf));
}

Coverage cover_clusters(const std::vector<uint32_t>& clusters, uint32_t lights,
                        const std::vector<float>& pdf) {
  Integrals area, weighted;
  for (size_t i = 0; i < clusters.size(); ++i) {
    const int count = clusters[i] < lights ? 1 : 0;
    area.add(1, count);
    if (!pdf.empty()) weighted.add(pdf[i], count);
  }
  return means(area, weighted);
}

std::optional<Coverage> coverage_of(const RsmShapes& shapes, uint32_t lights, uint32_t width, uint32_t height,
                                    const std::vector<float>& pdf) {
  if (!shapes.squares.empty()) return cover_footprints(shapes.squares, width, height, pdf);
  if (!shapes.clusters.empty()) return cover_clusters(shapes.clusters, lights, pdf);
  return std::nullopt;
}

}  // namespace vsglbench
