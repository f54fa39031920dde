#include "operation/sg_shade.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

namespace vsglbench::sg_shade {
namespace {

using glm::dvec3;
using std::numbers::pi;

constexpr double kStep = 0x1p-21, kUnderflow = 0x1p-124;  // of four steps that may be flushed
constexpr float kOpposed = 3.14159265f;

// Unit, at this cosine from z.
dvec3 about_z(double cosine, double azimuth) {
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

struct Tangents {
  explicit Tangents(const dvec3& axis) {
    const dvec3 other = std::abs(axis.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    first = glm::normalize(glm::cross(axis, other));
    second = glm::cross(axis, first);
  }
  dvec3 first, second;
};

// At `angle` from -way; exactly along it or opposed at the ends.
dvec3 lobe_axis(const dvec3& way, float angle, float azimuth) {
  if (angle >= kOpposed) return way;
  const Tangents t(way);
  const double a = angle, phi = azimuth;
  return -std::cos(a) * way + std::sin(a) * (std::cos(phi) * t.first + std::sin(phi) * t.second);
}

// A frame that no coordinate plane favours.
dvec3 turned(const dvec3& v, bool turn) {
  if (!turn) return v;
  const dvec3 z = glm::normalize(dvec3(0.48, -0.6, 0.64)),
              x = glm::normalize(glm::cross(z, dvec3(0.2, 0.9, 0.3)));
  return v.x * x + v.y * glm::cross(z, x) + v.z * z;
}

void append(const dvec3& v, std::vector<float>* out) {
  for (int k = 0; k < 3; ++k) out->push_back(static_cast<float>(v[k]));
}

struct Scene {
  exact::Surface surface;
  gpu::Vsgl light{};
};

Scene scene_of(const float* a) {
  const auto vector = [a](int i) { return glm::vec3(a[i], a[i + 1], a[i + 2]); };
  Scene s;
  s.surface = {dvec3(0), vector(14), vector(14), vector(17), dvec3(a[20]), dvec3(a[21]), a[22]};
  s.light.mean = vector(0);
  s.light.variance = a[3];
  s.light.diffuse_axis = vector(4);
  s.light.diffuse_sharpness = a[7];
  s.light.specular_axis = vector(8);
  s.light.specular_sharpness = a[11];
  s.light.diffuse = glm::vec3(a[12]);
  s.light.specular = glm::vec3(a[13]);
  s.light.power = 1;
  return s;
}

// Σ |change of value| over the ways that a scene is off by a step.
double changes(const Scene& scene, double value, const std::function<double(const Scene&)>& shade) {
  double sum = 0;
  const auto with = [&](auto&& change) {
    Scene s = scene;
    change(s);
    sum += std::abs(shade(s) - value);
  };
  for (const double step : {-kStep, kStep}) {
    const auto turn = [&](auto direction_of) {
      const dvec3 v(direction_of(const_cast<Scene&>(scene)));
      const double length = glm::length(v);
      const Tangents t(v / length);
      for (const dvec3& tangent : {t.first, t.second}) {
        with([&](Scene& s) {
          auto& moved = direction_of(s);
          moved = v + step * length * tangent;
        });
      }
    };
    turn([](Scene& s) -> glm::vec3& { return s.light.mean; });
    turn([](Scene& s) -> glm::vec3& { return s.light.diffuse_axis; });
    turn([](Scene& s) -> glm::vec3& { return s.light.specular_axis; });
    turn([](Scene& s) -> dvec3& { return s.surface.normal; });
    turn([](Scene& s) -> dvec3& { return s.surface.view; });
    const float factor = static_cast<float>(1 + step);
    with([&](Scene& s) { s.light.mean *= factor; });
    with([&](Scene& s) { s.light.variance *= factor; });
    with([&](Scene& s) { s.light.diffuse_sharpness *= factor; });
    with([&](Scene& s) { s.light.specular_sharpness *= factor; });
  }
  return sum;
}

// What a step of the kernel that underflows is multiplied by afterwards, at most: Vulkan lets a device flush
// any result below 2^-126 to 0. The steps of a lobe: exp, times `scale`, times the receiver's reflection (of
// three products), times the light's intensity, which comes last. And both lobes' diffuse reflection at L
// = 1.
struct Bounds {
  double after_flush = 0, full_diffuse = 0;
};
Bounds bounds(const Scene& scene) {
  const gpu::Vsgl& l = scene.light;
  const double distance2 = glm::dot(dvec3(l.mean), dvec3(l.mean));
  const double variance = std::max<double>(l.variance, distance2 * 0x1p-41), sharpness = distance2 / variance;
  const double albedo = scene.surface.diffuse.x, scale = 1 / (2 * pi * variance);
  const double ndf = scene.surface.ndf,
               nv = std::max(glm::dot(scene.surface.normal, scene.surface.view), 0.01);
  const double peak = ndf > 0 ? 1 / (pi * ndf * ndf) : (2 - ndf) / (2 * pi);
  Bounds b;
  // An integral times albedo is 4 or less, and peak · F V n·l times an integral 0.5 peak/nv.
  const double reflection = 4 + 0.5 * peak / nv;
  b.after_flush = (l.diffuse.x + l.specular.x) * (1 + reflection + scale * reflection);
  const auto add = [&](double intensity, const dvec3& axis, double lobe) {
    const auto p = exact::sg_product(glm::normalize(dvec3(l.mean)), sharpness, -axis, lobe);
    b.full_diffuse +=
        scale * intensity * std::exp(p.log_amplitude) * exact::sg_integral(p.sharpness) * albedo / pi;
  };
  add(l.diffuse.x, l.diffuse_axis, l.diffuse_sharpness);
  add(l.specular.x, l.specular_axis, l.specular_sharpness);
  return b;
}

}  // namespace

const std::vector<std::string>& columns() {
  static const std::vector<std::string> names = {"distance",
                                                 "variance",
                                                 "light_cosine",
                                                 "light_azimuth",
                                                 "diffuse_angle",
                                                 "diffuse_azimuth",
                                                 "diffuse_sharpness",
                                                 "diffuse_intensity",
                                                 "specular_angle",
                                                 "specular_azimuth",
                                                 "specular_sharpness",
                                                 "specular_intensity",
                                                 "view_cosine",
                                                 "albedo",
                                                 "f0",
                                                 "ndf",
                                                 "frame"};
  return names;
}

std::pair<double, double> domain(const std::string& column) {
  if (column == "distance") return {1e-6f, 1e6};
  if (column == "variance") return {0, 1e6};
  if (column == "ndf") return {-65535, 1};
  if (column.ends_with("cosine")) return {-1, 1};
  if (column.ends_with("azimuth")) return {-kOpposed, kOpposed};
  if (column.ends_with("angle")) return {0, kOpposed};
  if (column.ends_with("sharpness")) return {0, 0x1p41};
  if (column.ends_with("intensity")) return {0, 1e20f};
  return {0, 1};
}

std::string out_of_domain(const std::string& column, float value) {
  const auto [least, most] = domain(column);
  if (column == "ndf" && !((value >= 1e-3f && value <= 1) || (value >= -65535 && value <= -1))) {
    return fmt::format("ndf is {}, not in [0.001, 1] (GGX) or [-65535, -1] (Phong)", value);
  }
  if (value >= least && value <= most) return "";
  return fmt::format("{} is {}, not in [{}, {}]", column, value, static_cast<float>(least),
                     static_cast<float>(most));
}

void append_arguments(std::span<const float> row, std::vector<float>* out) {
  const bool turn = row[16] != 0;
  const dvec3 way = about_z(row[2], row[3]);
  append(turned(way, turn) * static_cast<double>(row[0]), out);
  out->push_back(row[1]);
  append(turned(lobe_axis(way, row[4], row[5]), turn), out);
  out->push_back(row[6]);
  append(turned(lobe_axis(way, row[8], row[9]), turn), out);
  out->push_back(row[10]);
  out->insert(out->end(), {row[7], row[11]});
  append(turned({0, 0, 1}, turn), out);
  append(turned(about_z(row[12], 0), turn), out);
  out->insert(out->end(), row.begin() + 13, row.begin() + 16);
}

Answer answer(const float* arguments, exact::DiffuseModel model) {
  const Scene scene = scene_of(arguments);
  const auto shade = [model](const Scene& s) { return exact::shade_vsgl(s.surface, s.light, {model}).x; };
  const Bounds b = bounds(scene);
  Answer a;
  a.value = shade(scene);
  a.scale = std::abs(a.value) + changes(scene, a.value, shade) / kStep;
  if (model != exact::DiffuseModel::cosine) a.scale += b.full_diffuse;
  a.floor = kUnderflow * (1 + b.after_flush);
  return a;
}

}  // namespace vsglbench::sg_shade
