#include "operation/sg_receiver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "operation/sg_shade.h"

namespace vsglbench::sg_receiver {
namespace {

using glm::dvec3;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// A frame that no coordinate plane favours.
dvec3 turned(const dvec3& v) {
  const dvec3 z = glm::normalize(dvec3(0.48, -0.6, 0.64)),
              x = glm::normalize(glm::cross(z, dvec3(0.2, 0.9, 0.3)));
  return v.x * x + v.y * glm::cross(z, x) + v.z * z;
}

void append(const dvec3& v, std::vector<float>* out) {
  for (int k = 0; k < 3; ++k) out->push_back(static_cast<float>(turned(v)[k]));
}

// A width of the lobe off its axis, degrees.
float width(float ndf, float view, float plane) {
  const double sharpness = ndf > 0 ? 2 / (double{ndf} * ndf) : -ndf;
  const double across = plane == 90 ? std::cos(radians(view)) : 1;
  return static_cast<float>(std::min(2 * across / std::sqrt(sharpness) * 180 / std::numbers::pi, 30.0));
}

}  // namespace

const std::vector<std::string>& columns() {
  static const std::vector<std::string> names = {"ndf", "f0", "view", "offset", "plane", "sharpness"};
  return names;
}

std::pair<double, double> domain(const std::string& column) {
  if (column == "ndf") return sg_shade::domain("ndf");
  if (column == "f0") return {0, 1};
  if (column == "view") return {0, 90};
  if (column == "offset") return {0, 180};
  if (column == "plane") return {-180, 180};
  return {0, 0x1p41};
}

std::string out_of_domain(const std::string& column, float value) {
  if (column == "ndf") return sg_shade::out_of_domain(column, value);
  const auto [least, most] = domain(column);
  if (value >= least && value <= most) return "";
  return fmt::format("{} is {}, not in [{}, {}]", column, value, static_cast<float>(least),
                     static_cast<float>(most));
}

void append_arguments(std::span<const float> row, std::vector<float>* out) {
  const double view = radians(row[2]), offset = radians(row[3]), plane = radians(row[4]);
  const dvec3 mirror(-std::sin(view), 0, std::cos(view)), away(-std::cos(view), 0, -std::sin(view));
  append(std::cos(offset) * mirror +
             std::sin(offset) * (std::cos(plane) * away + std::sin(plane) * dvec3(0, 1, 0)),
         out);
  out->push_back(row[5]);
  append({0, 0, 1}, out);
  append({std::sin(view), 0, std::cos(view)}, out);
  out->insert(out->end(), {row[1], row[0]});
}

double integral(const float* a) {
  const auto unit = [a](int i) { return glm::normalize(dvec3(a[i], a[i + 1], a[i + 2])); };
  const exact::Surface surface{dvec3(0), unit(4), unit(4), unit(7), dvec3(0), dvec3(a[10]), a[11]};
  return exact::reflected_radiance(surface, exact::incoming_sg(unit(0), a[3]), 1e-4).value.x;
}

std::vector<float> table_rows() {
  constexpr float ndfs[] = {-30, -300, -1023, -65535, 0.05f, 0.1f, 0.3f, 1};
  std::vector<float> rows;
  const auto add = [&](float ndf, float f0, float sharpness) {
    for (const float view : kViews) {
      rows.insert(rows.end(), {ndf, f0, view, 0, 0, sharpness});
      for (const float plane : {0.0f, 180.0f, 90.0f})
        rows.insert(rows.end(), {ndf, f0, view, width(ndf, view, plane), plane, sharpness});
    }
  };
  for (const float ndf : ndfs) {
    const float sharpness = ndf > 0 ? 2 / (ndf * ndf) : -ndf;
    add(ndf, 1, sharpness);
    add(ndf, 1, sharpness / 16);
    if (ndf == -300 || ndf == 0.1f) add(ndf, 0.04f, sharpness);
  }
  return rows;
}

}  // namespace vsglbench::sg_receiver
