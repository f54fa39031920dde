// The integrals of sg_exact.h. With u = 1-ω·v, a = (v·n)(1-u) and b = √((1-(v·n)²)u(2-u)), ω·n = a + b cos φ
// at azimuth φ about v: the azimuth is integrated by hand, and u over [0,2] by quadrature. The circle about v
// meets the horizon of n for u between two kinks u0 and 2-u0, inside which it is above it for |φ| < φ0.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "shaders/sg_exact.h"

namespace vsglbench::exact {
namespace {

using std::numbers::pi;

// Gauss–Kronrod (7,15) on [-1,1] (Piessens et al. 1983, QUADPACK); the odd nodes are Gauss's.
constexpr std::array<double, 8> kNodes = {
    0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
    0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
    0.586087235467691130294144838258730, 0.405845151377397166906606412076961,
    0.207784955007898467600689403773245, 0};
constexpr std::array<double, 8> kKronrod = {
    0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
    0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
    0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
    0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
constexpr std::array<double, 4> kGauss = {
    0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
    0.381830050505118944950369775488975, 0.417959183673469387755102040816327};
constexpr double kTolerance = 1e-11;  // of each interval, relative to the whole
constexpr int kMostSplits = 2000;

// A direction's distance u from v, and its distance from the kinks, each without cancellation at its own end.
struct Place {
  double u, above_low, below_high;  // u-u0 and (2-u0)-u
};

// ω·n around the circle at u.
struct Circle {
  double a, b, root, phi;  // root = √(b²-a²); phi: above the horizon for azimuths |φ| < phi
};

class Horizon {
 public:
  explicit Horizon(double cosine)
      : cosine_(cosine),
        sine2_((1 - cosine) * (1 + cosine)),
        low_(cosine * cosine / (1 + std::sqrt(sine2_))) {}
  double low() const { return low_; }  // u0 = 1-√(1-c²)
  double high() const { return 2 - low_; }
  // No circle nearer than this has a point above the horizon.
  double start() const { return cosine_ < 0 ? low_ : 0; }

  Circle circle(const Place& at) const {
    Circle c;
    c.a = cosine_ * (1 - at.u);
    c.b = std::sqrt(sine2_ * at.u * (2 - at.u));
    const double root2 = at.above_low * at.below_high;
    c.root = root2 > 0 ? std::sqrt(root2) : 0;
    c.phi = root2 > 0 ? std::atan2(c.root, -c.a) : c.a > 0 ? pi : 0;
    return c;
  }

 private:
  double cosine_, sine2_, low_;
};

// Mean over the azimuth of max(a + b cos φ, 0) = (a φ0 + √(b²-a²))/π = b (sin φ0 - φ0 cos φ0)/π.
double mean_cosine(const Circle& c) {
  if (c.phi == 0) return 0;
  if (c.root == 0) return c.a;
  if (c.phi > 0.05) return (c.a * c.phi + c.root) / pi;
  const double p2 = c.phi * c.phi;
  return c.b * c.phi * p2 * (1 / 3.0 - p2 * (1 / 30.0 - p2 * (1 / 840.0 - p2 / 45360.0))) / pi;
}

// Half of a segment, in y: u = end + sign y². Square-root behaviour at `end` becomes analytic.
struct Interval {
  double end, sign, from, to;  // from and to in y
  double value = 0, error = 0;
};

class Quadrature {
 public:
  Quadrature(const Horizon& horizon, std::function<double(const Place&)> integrand)
      : horizon_(horizon), integrand_(std::move(integrand)) {}

  // Over u in [from,to], split at the kinks inside.
  double integrate(double from, double to) {
    std::vector<double> ends = {from};
    for (const double kink : {horizon_.low(), horizon_.high()}) {
      if (kink > ends.back() && kink < to) ends.push_back(kink);
    }
    ends.push_back(to);
    double total = 0;
    std::vector<Interval> open;
    for (size_t i = 0; i + 1 < ends.size(); ++i) {
      const double half = std::sqrt(0.5 * (ends[i + 1] - ends[i]));
      for (const double sign : {1.0, -1.0}) {
        open.push_back(evaluated({sign > 0 ? ends[i] : ends[i + 1], sign, 0, half}));
        total += open.back().value;
      }
    }
    for (int splits = 0; !open.empty() && splits < kMostSplits;) {
      const Interval whole = open.back();
      open.pop_back();
      if (!(whole.error > kTolerance * std::abs(total))) continue;
      ++splits;
      const double middle = 0.5 * (whole.from + whole.to);
      total -= whole.value;
      for (const auto& [a, b] : {std::pair(whole.from, middle), std::pair(middle, whole.to)}) {
        open.push_back(evaluated({whole.end, whole.sign, a, b}));
        total += open.back().value;
      }
    }
    return total;
  }

 private:
  double at(const Interval& i, double y) const {
    const double step = i.sign * y * y, u = i.end + step;
    const double above = i.end == horizon_.low() ? step : u - horizon_.low();
    const double below = i.end == horizon_.high() ? -step : horizon_.high() - u;
    return integrand_({std::clamp(u, 0.0, 2.0), above, below}) * 2 * y;
  }

  Interval evaluated(Interval i) const {
    const double middle = 0.5 * (i.from + i.to), half = 0.5 * (i.to - i.from);
    double kronrod = 0, gauss = 0;
    for (size_t k = 0; k < kNodes.size(); ++k) {
      double f = at(i, middle + half * kNodes[k]);
      if (kNodes[k] > 0) f += at(i, middle - half * kNodes[k]);
      kronrod += kKronrod[k] * f;
      if (k % 2 == 1) gauss += kGauss[k / 2] * f;
    }
    i.value = half * kronrod;
    // QUADPACK's estimate: the Kronrod sum is far better than its distance from Gauss's says.
    const double distance = std::abs(half * (kronrod - gauss)), size = std::abs(i.value);
    i.error = size > 0 ? std::min(distance, size * std::pow(200 * distance / size, 1.5)) : distance;
    return i;
  }

  const Horizon& horizon_;
  std::function<double(const Place&)> integrand_;
};

// Past e^{-60} of the largest value on the way, nothing is left to a double.
double last(double start, double sharpness, double end) {
  return sharpness * (end - start) > 60 ? start + 60 / sharpness : end;
}

}  // namespace

double clamped_cosine(double cosine, double sharpness) {
  const Horizon horizon(cosine);
  Quadrature q(horizon,
               [&](const Place& p) { return std::exp(-sharpness * p.u) * mean_cosine(horizon.circle(p)); });
  const double start = horizon.start();
  return q.integrate(start, last(start, sharpness, 2)) / (2 * expm1_over_x(-2 * sharpness));
}

double hemispherical_integral(double cosine, double sharpness) {
  const Horizon horizon(cosine);
  Quadrature q(horizon,
               [&](const Place& p) { return 2 * std::exp(-sharpness * p.u) * horizon.circle(p).phi; });
  const double start = horizon.start();
  return q.integrate(start, last(start, sharpness, 2));
}

// The fraction f(u) of a circle that is above the horizon has f(u) + f(2-u) = 1: so with
// w(u) = e^{-κu} - e^{-κ(2-u)}, s = ∫₀¹ f w du / ∫₀¹ w du, a mean of what is never negative.
double normalized_hemisphere(double cosine, double sharpness) {
  const Horizon horizon(cosine);
  Quadrature q(horizon, [&](const Place& p) {
    const double weight = 2 * (1 - p.u) * expm1_over_x(-2 * sharpness * (1 - p.u));  // w e^{κu}/κ
    return std::exp(-sharpness * p.u) * weight * horizon.circle(p).phi / pi;
  });
  const double start = horizon.start();
  const double whole = expm1_over_x(-sharpness);
  return q.integrate(start, last(start, sharpness, 1)) / (whole * whole);
}

}  // namespace vsglbench::exact
