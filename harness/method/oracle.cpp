#include "method/oracle.h"

#include <algorithm>
#include <cmath>

#include "method/lattice.h"

namespace vsglbench::oracle {
namespace {

constexpr double kPi = 3.14159265358979323846;

glm::dvec3 reflect(const glm::dvec3& view, const glm::dvec3& n) { return 2 * glm::dot(view, n) * n - view; }

double ndf_sharpness(double ndf) { return ndf > 0 ? 2 / (ndf * ndf) : -ndf; }

// F G2 times the lobe's normalisation (1 for GGX, (n+2)/n for Phong).
glm::dvec3 specular_reflectance(const Texel& t, double cosine) {
  const double alpha = t.ndf > 0 ? t.ndf : std::sqrt(2.0 / (2.0 - t.ndf));
  const double tan2 = 1 / (cosine * cosine) - 1;
  const double lambda = 0.5 * (std::sqrt(1 + alpha * alpha * tan2) - 1);  // Heitz 2014
  const double g2 = 1 / (1 + 2 * lambda);
  const glm::dvec3 f0(t.f0);
  const double f90 = std::min(1.0, 50 * std::max({f0.x, f0.y, f0.z}));
  const glm::dvec3 f = f0 + (glm::dvec3(f90) - f0) * std::pow(1 - cosine, 5);
  return f * (g2 * (t.ndf > 0 ? 1.0 : (2.0 - t.ndf) / -t.ndf));
}

}  // namespace

double luminance(const glm::dvec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

Sums& Sums::add(const Sums& o, double f) {
  diffuse += f * o.diffuse;
  specular += f * o.specular;
  diffuse_direction += f * o.diffuse_direction;
  specular_direction += f * o.specular_direction;
  position += f * o.position;
  square += f * o.square;
  return *this;
}

glm::dvec3 texel_flux(const gpu::Emitter& e, uint32_t x, uint32_t y) {
  const double px = (2.0 * (x + 0.5) / e.width - 1) * e.extent.x,
               py = (1 - 2.0 * (y + 0.5) / e.height) * e.extent.y;
  const double area = 4.0 * e.extent.x * e.extent.y / (double(e.width) * e.height);
  if (e.importance) return glm::dvec3(1.0 / (double(e.width) * e.height));
  const double cos3 = e.perspective ? std::pow(1 + px * px + py * py, -1.5) : 1;
  return glm::dvec3(e.power) * area * cos3;
}

Sums texel_sums(const Half& half, uint32_t x, uint32_t y) {
  const gpu::Emitter& e = half.emitter;
  const Texel& t = half.texels[size_t(y) * e.width + x];
  Sums s;
  if (!t.surface) return s;
  // The float normal is unit only to 1e-7, which 1-r of a sharp lobe would show.
  const glm::dvec3 p(t.position), n = glm::normalize(glm::dvec3(t.normal));
  const glm::dvec3 to = glm::dvec3(e.position) - p;
  const glm::dvec3 view = e.perspective ? glm::normalize(to) : -glm::dvec3(e.forward);
  const double cosine = std::max(glm::dot(n, view), 1e-3);
  const glm::dvec3 flux = texel_flux(e, x, y);
  s.diffuse = flux * glm::dvec3(t.diffuse);
  s.specular = flux * glm::min(specular_reflectance(t, cosine), glm::dvec3(1));
  const double sharp = ndf_sharpness(t.ndf) / (4 * cosine);
  s.diffuse_direction = luminance(s.diffuse) * (2.0 / 3.0) * n;
  s.specular_direction = luminance(s.specular) * (sharp / (sharp + 1)) * reflect(view, n);
  const double w = luminance(s.diffuse) + luminance(s.specular);
  s.position = w * p;
  // A texel is a square of area a on the surface, with variance a/6.
  const double px = (2.0 * (x + 0.5) / e.width - 1) * e.extent.x,
               py = (1 - 2.0 * (y + 0.5) / e.height) * e.extent.y;
  const double area = 4.0 * e.extent.x * e.extent.y / (double(e.width) * e.height);
  const double solid = e.perspective ? area * std::pow(1 + px * px + py * py, -1.5) * glm::dot(to, to) : area;
  const double cos_surface =
      std::max(glm::dot(glm::dvec3(t.geometric_normal), view), double(e.footprint_cosine));
  s.square = w * (glm::dot(p, p) + solid / cos_surface / 6);
  return s;
}

Vsgl make_vsgl(const Sums& s, double factor) {
  Vsgl v;
  const double wd = luminance(s.diffuse), ws = luminance(s.specular), w = wd + ws;
  if (!(w > 0)) return v;
  const auto lobe = [&](const glm::dvec3& power, const glm::dvec3& direction, double weight, glm::dvec3* axis,
                        double* sharpness) {
    const glm::dvec3 mean = direction / weight;
    const double r = glm::length(mean);
    *axis = mean / r;
    *sharpness = r / (1 - r);
    return factor * power * *sharpness / (2 * kPi * -std::expm1(-2 * *sharpness));
  };
  if (wd > 0) v.diffuse = lobe(s.diffuse, s.diffuse_direction, wd, &v.diffuse_axis, &v.diffuse_sharpness);
  if (ws > 0)
    v.specular = lobe(s.specular, s.specular_direction, ws, &v.specular_axis, &v.specular_sharpness);
  v.mean = s.position / w;
  v.variance = s.square / w - glm::dot(v.mean, v.mean);
  v.power = factor * w;
  return v;
}

Pyramid::Pyramid(const Half& half) : width_(half.emitter.width), height_(half.emitter.height) {
  uint32_t top = 0;
  while ((1u << top) < std::max(width_, height_)) ++top;
  double mean = 0;
  for (const float p : half.pdf) mean += p;
  mean /= double(width_) * height_;
  for (uint32_t l = 0; l <= top; ++l) {
    const uint32_t block = 1u << l;
    Level level{(width_ + block - 1) / block, (height_ + block - 1) / block, {}, {}};
    for (uint32_t by = 0; by < level.height; ++by) {
      for (uint32_t bx = 0; bx < level.width; ++bx) {
        double p = 0, n = 0;
        Sums sums;
        for (uint32_t y = by * block; y < std::min(height_, (by + 1) * block); ++y) {
          for (uint32_t x = bx * block; x < std::min(width_, (bx + 1) * block); ++x) {
            p += half.pdf[size_t(y) * width_ + x] / mean;
            sums.add(texel_sums(half, x, y), 1);
            n += 1;
          }
        }
        level.pdf.push_back(p / n);
        level.sums.push_back(Sums().add(sums, 1 / n));
      }
    }
    levels_.push_back(std::move(level));
  }
}

namespace {

// The weight of the upper of two texels on one axis, the last of which may cover a part c of its block: such
// that its weight at all base texels together is what it covers. Linear weights are for c >= 1/2; below,
// their sum is (1/2 + c)²/2.
double upper_weight(uint32_t base, uint32_t level, uint32_t upper, double f) {
  const double block = 1u << level, c = std::min(1.0, base / block - upper);
  return c < 0.5 ? f * c / ((0.5 + c) * (0.5 + c) / 2) : f;
}

}  // namespace

template <class Value, class Get>
Value Pyramid::bilinear(double px, double py, uint32_t l, const Get& get) const {
  const Level& level = levels_[l];
  const double scale = 1u << l;
  const double x = std::clamp(px / scale - 0.5, 0.0, double(level.width - 1));
  const double y = std::clamp(py / scale - 0.5, 0.0, double(level.height - 1));
  const auto x0 = static_cast<uint32_t>(x), y0 = static_cast<uint32_t>(y);
  const uint32_t x1 = std::min(x0 + 1, level.width - 1), y1 = std::min(y0 + 1, level.height - 1);
  const double fx = upper_weight(width_, l, x1, x - x0), fy = upper_weight(height_, l, y1, y - y0);
  Value v{};
  get(v, level, y0 * level.width + x0, (1 - fx) * (1 - fy));
  get(v, level, y0 * level.width + x1, fx * (1 - fy));
  get(v, level, y1 * level.width + x0, (1 - fx) * fy);
  get(v, level, y1 * level.width + x1, fx * fy);
  return v;
}

double Pyramid::pdf(double px, double py, double level) const {
  const auto lo = static_cast<uint32_t>(level);
  const double f = level - lo;
  const auto get = [](double& v, const Level& l, uint32_t i, double w) { v += w * l.pdf[i]; };
  return (1 - f) * bilinear<double>(px, py, lo, get) +
         f * bilinear<double>(px, py, std::min(lo + 1, top()), get);
}

Sums Pyramid::sums(double px, double py, double level) const {
  const auto lo = static_cast<uint32_t>(level);
  const double f = level - lo;
  const auto get = [](Sums& v, const Level& l, uint32_t i, double w) { v.add(l.sums[i], w); };
  Sums s;
  s.add(bilinear<Sums>(px, py, lo, get), 1 - f);
  return s.add(bilinear<Sums>(px, py, std::min(lo + 1, top()), get), f);
}

double Pyramid::mass(uint32_t l, uint32_t x, uint32_t y) const {
  const Level& level = levels_[l];
  if (x >= level.width || y >= level.height) return 0;
  const uint32_t block = 1u << l;
  const double w = std::min(width_, (x + 1) * block) - x * block,
               h = std::min(height_, (y + 1) * block) - y * block;
  return level.pdf[size_t(y) * level.width + x] * w * h;
}

glm::uvec2 Pyramid::warp(double ux, double uy) const {
  glm::uvec2 t(0);
  const auto choose = [](double a, double b, double& u) {
    const double p = a / (a + b);
    const bool second = b > 0 && (u >= p || a <= 0);
    u = second ? (u - p) / (1 - p) : u / p;
    u = std::clamp(u, 0.0, 1 - 1e-16);
    return second ? 1u : 0u;
  };
  for (uint32_t l = top(); l-- > 0;) {
    t *= 2u;
    const double a = mass(l, t.x, t.y), b = mass(l, t.x + 1, t.y), c = mass(l, t.x, t.y + 1),
                 d = mass(l, t.x + 1, t.y + 1);
    const uint32_t dy = choose(a + b, c + d, uy);
    const uint32_t dx = dy ? choose(c, d, ux) : choose(a, b, ux);
    t += glm::uvec2(dx, dy);
  }
  return t;
}

Vsgl filtered_light(const Half& half, const Pyramid& pyramid, LightRule rule, double k, uint32_t count,
                    glm::uvec2 fixed) {
  const glm::dvec2 u = unit_interval(fixed);
  const glm::uvec2 t = pyramid.warp(u.x, u.y);
  const double x = t.x + 0.5, y = t.y + 0.5, m = double(half.emitter.width) * half.emitter.height;
  double level = 0, share = 0;
  if (rule == LightRule::pdf_at_centre) {
    const double p = pyramid.pdf(x, y, 0);
    level = std::max(0.0, std::log2(std::min(k / (count * p), 1.0) * m) / 2);
    share = 1 / std::max(count * p, 1.0);
  } else {
    double lo = 0, hi = pyramid.top();
    for (int i = 0; i < 12; ++i) {
      level = (lo + hi) / 2;
      (std::exp2(2 * level) / m * pyramid.pdf(x, y, level) < k / count ? lo : hi) = level;
    }
    level = hi * 4096 <= 1.5 * pyramid.top() ? 0 : (lo + hi) / 2;
    share = 1 / (count * pyramid.pdf(x, y, level));
  }
  Vsgl v = make_vsgl(pyramid.sums(x, y, level), share * m);
  v.level = level;
  return v;
}

}  // namespace vsglbench::oracle
