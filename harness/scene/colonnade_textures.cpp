#include "scene/colonnade_textures.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace vsglbench {
namespace {

// PCG hash of a lattice point (Jarzynski and Olano 2020), to [0,1).
double hash01(uint32_t x, uint32_t y, uint32_t seed) {
  uint32_t h = x * 0x9e3779b9u ^ (y * 0x85ebca6bu + seed * 0xc2b2ae35u);
  for (int k = 0; k < 2; ++k) {
    h = h * 747796405u + 2891336453u;
    h = ((h >> ((h >> 28) + 4)) ^ h) * 277803737u;
    h = (h >> 22) ^ h;
  }
  return (h >> 8) / 16777216.0;
}

double smooth(double t) { return t * t * (3 - 2 * t); }
double smooth_step(double low, double high, double x) {
  return smooth(std::clamp((x - low) / (high - low), 0.0, 1.0));
}

// Value noise over [0,1)^2 with `period` lattice cells each way, in [0,1].
double value_noise(double u, double v, uint32_t period, uint32_t seed) {
  const double x = u * period, y = v * period;
  const uint32_t x0 = static_cast<uint32_t>(x) % period, y0 = static_cast<uint32_t>(y) % period;
  const uint32_t x1 = (x0 + 1) % period, y1 = (y0 + 1) % period;
  const double fx = smooth(x - std::floor(x)), fy = smooth(y - std::floor(y));
  const double low = hash01(x0, y0, seed) * (1 - fx) + hash01(x1, y0, seed) * fx;
  const double high = hash01(x0, y1, seed) * (1 - fx) + hash01(x1, y1, seed) * fx;
  return low * (1 - fy) + high * fy;
}

// Octaves of value noise, each twice as fine and half as strong; in [0,1].
double fractal_noise(double u, double v, uint32_t period, int octaves, uint32_t seed) {
  double sum = 0, weight = 1, total = 0;
  for (int k = 0; k < octaves; ++k, period *= 2, weight *= 0.5) {
    sum += weight * value_noise(u, v, period, seed + static_cast<uint32_t>(k));
    total += weight;
  }
  return sum / total;
}

uint8_t to_byte(double v) { return static_cast<uint8_t>(std::clamp(v, 0.0, 1.0) * 255 + 0.5); }

using Color = std::function<glm::dvec3(double u, double v)>;  // sRGB-encoded
using Height = std::function<double(double u, double v)>;     // in texture widths

// Central differences of the relief; y of a normal map points up the image, v down it.
glm::dvec3 relief_normal(const Height& height, double u, double v, uint32_t size) {
  const double h = 1.0 / size;
  const auto at = [&](double a, double b) { return height(a - std::floor(a), b - std::floor(b)); };
  return glm::normalize(glm::dvec3(at(u - h, v) - at(u + h, v), at(u, v + h) - at(u, v - h), 2 * h));
}

TexturePair bake(const char* name, uint32_t size, const Color& color, const Height& height,
                 const std::function<glm::dvec2(double, double)>& tilt = nullptr) {
  TexturePair pair;
  pair.color = {std::string(name) + " colour", size, size, true, {}};
  pair.normal = {std::string(name) + " normal", size, size, false, {}};
  for (uint32_t y = 0; y < size; ++y) {
    for (uint32_t x = 0; x < size; ++x) {
      const double u = (x + 0.5) / size, v = (y + 0.5) / size;
      const glm::dvec3 c = color(u, v);
      glm::dvec3 n = relief_normal(height, u, v, size);
      if (tilt) n = glm::normalize(n + glm::dvec3(tilt(u, v), 0));
      for (int k = 0; k < 3; ++k) {
        pair.color.rgba.push_back(to_byte(c[k]));
        pair.normal.rgba.push_back(to_byte(0.5 + 0.5 * n[k]));
      }
      pair.color.rgba.push_back(255);
      pair.normal.rgba.push_back(255);
    }
  }
  return pair;
}

// The cell of a brick or tile pattern at (u,v): its indices, and the distance to its nearest edge in texture
// widths.
struct Cell {
  uint32_t x, y;
  double edge;
};
Cell cell_at(double u, double v, uint32_t columns, uint32_t rows, bool shifted) {
  const double y = v * rows;
  const uint32_t row = std::min(static_cast<uint32_t>(y), rows - 1);
  double x = u * columns + (shifted && row % 2 == 1 ? 0.5 : 0.0);
  if (x >= columns) x -= columns;
  const uint32_t column = std::min(static_cast<uint32_t>(x), columns - 1);
  const double fx = x - column, fy = y - row;
  return {column, row, std::min(std::min(fx, 1 - fx) / columns, std::min(fy, 1 - fy) / rows)};
}

}  // namespace

TexturePair ashlar_textures(uint32_t size) {
  constexpr double kJoint = 0.004;
  const auto cell = [](double u, double v) { return cell_at(u, v, 4, 8, true); };
  return bake(
      "ashlar", size,
      [&](double u, double v) {
        const Cell c = cell(u, v);
        const double stone = 0.86 + 0.14 * (hash01(c.x, c.y, 11) - 0.5) * 2;
        const double grain = 0.82 + 0.36 * fractal_noise(u, v, 8, 6, 21);
        const double warm = hash01(c.x, c.y, 12);
        const glm::dvec3 base = glm::mix(glm::dvec3(0.74, 0.62, 0.48), glm::dvec3(0.70, 0.55, 0.42), warm);
        return glm::mix(glm::dvec3(0.50, 0.46, 0.41), stone * grain * base,
                        smooth_step(0.5 * kJoint, 1.2 * kJoint, c.edge));
      },
      [&](double u, double v) {
        const Cell c = cell(u, v);
        return 0.004 * smooth_step(0.4 * kJoint, 2.5 * kJoint, c.edge) +
               0.004 * fractal_noise(u, v, 16, 5, 31);
      });
}

TexturePair tile_textures(uint32_t size) {
  constexpr double kJoint = 0.003;
  const auto cell = [](double u, double v) { return cell_at(u, v, 4, 4, false); };
  return bake(
      "tiles", size,
      [&](double u, double v) {
        const Cell c = cell(u, v);
        // Veins: where a noise of each tile's own crosses its middle value.
        const double noise = fractal_noise(u, v, 8, 6, 40 + c.x + 4 * c.y);
        const double vein = 1 - smooth_step(0.0, 0.05, std::abs(noise - 0.5));
        const bool dark = (c.x + c.y) % 2 == 1;
        const glm::dvec3 base = dark ? glm::dvec3(0.52, 0.33, 0.26) : glm::dvec3(0.80, 0.76, 0.68);
        const glm::dvec3 veins = dark ? glm::dvec3(0.66, 0.50, 0.42) : glm::dvec3(0.66, 0.61, 0.54);
        const glm::dvec3 marble = glm::mix((0.85 + 0.3 * noise) * base, veins, 0.5 * vein);
        return glm::mix(glm::dvec3(0.38, 0.35, 0.32), marble, smooth_step(0.5 * kJoint, kJoint, c.edge));
      },
      [&](double u, double v) { return 0.0015 * smooth_step(0.3 * kJoint, 2 * kJoint, cell(u, v).edge); },
      [&](double u, double v) {
        const Cell c = cell(u, v);
        return 0.02 * glm::dvec2(hash01(c.x, c.y, 51) - 0.5, hash01(c.x, c.y, 52) - 0.5);
      });
}

TexturePair stone_textures(uint32_t size) {
  return bake(
      "stone", size,
      [](double u, double v) {
        const double grain = 0.80 + 0.3 * fractal_noise(u, v, 4, 7, 61);
        return grain * glm::dvec3(0.84, 0.79, 0.70);
      },
      [](double u, double v) { return 0.006 * fractal_noise(u, v, 16, 5, 71); });
}

TexturePair weave_textures(uint32_t size) {
  constexpr double kTwoPi = 6.283185307179586;
  const auto threads = [](double u, double v) {
    return 0.5 + 0.25 * (std::sin(kTwoPi * 64 * u) + std::sin(kTwoPi * 64 * v));
  };
  return bake(
      "weave", size,
      [&](double u, double v) {
        return glm::dvec3(0.80 + 0.12 * threads(u, v) + 0.08 * fractal_noise(u, v, 8, 4, 81));
      },
      [&](double u, double v) { return 0.0006 * threads(u, v); });
}

}  // namespace vsglbench
