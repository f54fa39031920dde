#include "shaders/cubature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>

namespace vsglbench::exact {
namespace {

using glm::dvec3;
using std::numbers::pi;

constexpr size_t kMostCells = 200000 / 17;

// Polar coordinates about a cone's axis.
struct Frame {
  explicit Frame(const dvec3& axis) : z(axis) {
    x = glm::normalize(glm::cross(z, std::abs(z.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    y = glm::cross(z, x);
  }
  dvec3 direction(double theta, double phi) const {
    return std::cos(theta) * z + std::sin(theta) * (std::cos(phi) * x + std::sin(phi) * y);
  }
  dvec3 x, y, z;
};

// The rectangle of half widths (a, b) about (theta, phi).
struct Cell {
  double theta, phi, a, b;
  dvec3 value{0};
  double error = 0;
  bool operator<(const Cell& other) const { return error < other.error; }
  std::array<Cell, 4> quarters() const {
    const double c = a / 2, d = b / 2;
    return {Cell{theta - c, phi - d, c, d}, Cell{theta - c, phi + d, c, d}, Cell{theta + c, phi - d, c, d},
            Cell{theta + c, phi + d, c, d}};
  }
  // Largest sine of a polar angle in the cell.
  double most_sine() const {
    const double low = theta - a, high = theta + a;
    return low < pi / 2 && high > pi / 2 ? 1 : std::sin(high < pi / 2 ? high : low);
  }
};

// ∫ over a cell by the 17 points of Genz and Malik's rule of degree 7; its error by theirs of degree 5.
template <class Function>
void evaluate(Cell& cell, const Function& f) {
  static const double l2 = std::sqrt(9.0 / 70), l3 = std::sqrt(9.0 / 10), l5 = std::sqrt(9.0 / 19);
  const auto at = [&](double u, double v) { return f(cell.theta + u * cell.a, cell.phi + v * cell.b); };
  const auto cross = [&](double l) { return at(l, 0) + at(-l, 0) + at(0, l) + at(0, -l); };
  const auto corners = [&](double l) { return at(l, l) + at(-l, l) + at(l, -l) + at(-l, -l); };
  const dvec3 centre = at(0, 0), near = cross(l2), far = cross(l3), diagonal = corners(l3);
  const double area = 4 * cell.a * cell.b;
  cell.value = area * (-3816 / 19683.0 * centre + 980 / 6561.0 * near + 1020 / 19683.0 * far +
                       200 / 19683.0 * diagonal + 6859 / 78732.0 * corners(l5));
  const dvec3 fifth =
      area * (-971 / 729.0 * centre + 245 / 486.0 * near + 65 / 1458.0 * far + 25 / 729.0 * diagonal);
  cell.error = glm::length(cell.value - fifth);
}

}  // namespace

dvec3 unit_or(const dvec3& v, const dvec3& fallback) {
  const double length = glm::length(v);
  return length > 1e-15 ? v / length : fallback;
}

// Cells are quartered where a peak could hide in one, then the worst of them.
Integral integrate(const Cone& cone, std::span<const Peak> peaks, double relative_error,
                   const std::function<dvec3(const dvec3&)>& f) {
  const Frame frame(cone.axis);
  const auto integrand = [&](double theta, double phi) {
    return std::sin(theta) * f(frame.direction(theta, phi));
  };
  const auto may_hide = [&](const Cell& c, const Peak& peak) {
    const double extent = c.a + c.b * c.most_sine();
    const double away = glm::length(frame.direction(c.theta, c.phi) - peak.direction);
    return extent > peak.width && away < extent + 4 * peak.width;
  };
  std::priority_queue<Cell> cells;
  dvec3 value(0);
  double error = 0;
  const std::function<void(Cell)> add = [&](Cell cell) {
    if (std::ranges::any_of(peaks, [&](const Peak& peak) { return may_hide(cell, peak); })) {
      for (const Cell& quarter : cell.quarters()) add(quarter);
      return;
    }
    evaluate(cell, integrand);
    value += cell.value;
    error += cell.error;
    cells.push(cell);
  };
  constexpr int kRows = 6, kColumns = 16;
  const double a = cone.half_angle / kRows / 2, b = pi / kColumns;
  for (int i = 0; i < kRows * kColumns; ++i)
    add({(2 * (i / kColumns) + 1) * a, (2 * (i % kColumns) + 1) * b, a, b});
  while (cells.size() < kMostCells && error > relative_error * glm::length(value)) {
    const Cell worst = cells.top();
    cells.pop();
    value -= worst.value;
    error -= worst.error;
    for (const Cell& quarter : worst.quarters()) add(quarter);
  }
  return {value, error};
}

}  // namespace vsglbench::exact
