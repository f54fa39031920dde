#include "scene/scene_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace vsglbench {
namespace {

constexpr double kDegree = 180 / std::numbers::pi;
constexpr size_t kMostMaterials = 64;  // that `about` lists

// A number of so many decimals, without the digits that binary adds.
double rounded(double value, int decimals) {
  return std::stod(fmt::format("{:.{}f}", value, std::max(0, decimals))) + 0.0;
}

Json numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// Of the scenery behind a lone object.
Json quad(const std::string& name, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v,
          const glm::dvec3& color) {
  return {{"name", name},
          {"quad", {{"corner", numbers(corner)}, {"u", numbers(u)}, {"v", numbers(v)}}},
          {"material", {{"base_color", numbers(color)}, {"roughness", 1}, {"specular", 0}}}};
}

}  // namespace

Json json_of(const GltfCamera& c) {
  return {
      {"eye", numbers(c.eye)}, {"direction", numbers(c.direction)}, {"up", numbers(c.up)}, {"vfov", c.vfov}};
}

Json json_of(const GltfLight& l) {
  if (l.type == GltfLight::Type::sun) {
    Json sun = {{"direction", numbers(l.direction)}, {"up", numbers(l.up)}, {"irradiance", numbers(l.power)}};
    if (l.half_extent) {
      sun["centre"] = numbers(l.position);
      sun["half_extent"] = {l.half_extent->x, l.half_extent->y};
    }
    return {{"sun", sun}};
  }
  return {{"spot",
           {{"position", numbers(l.position)},
            {"direction", numbers(l.direction)},
            {"up", numbers(l.up)},
            {"fov", l.fov},
            {"intensity", numbers(l.power)}}}};
}

SceneWriter::SceneWriter(const Scene& geometry)
    : geometry_(geometry),
      decimals_(3 - static_cast<int>(std::floor(std::log10(std::max(1e-30f, geometry.diagonal()))))) {}

Json SceneWriter::place(const glm::dvec3& p) const {
  return {rounded(p.x, decimals_), rounded(p.y, decimals_), rounded(p.z, decimals_)};
}

Json SceneWriter::view_of(const FoundView& found) const {
  const Camera& c = found.shot.camera;
  const Light& l = found.shot.light;
  const auto metres = static_cast<float>(std::max(found.measure.depth, 1e-3 * geometry_.diagonal()));
  const auto reach = std::max(static_cast<float>(found.measure.nearest), 1e-3f * geometry_.diagonal());
  return {{"description",
           fmt::format(
               "found from the bounds: {:.0f} % of the lit surface is seen, indirect light reaches {:.0f} % "
               "of the picture's surfaces",
               100 * found.measure.lit_seen, 100 * found.measure.reached)},
          {"camera",
           {{"eye", place(world(c.position))},
            {"target", place(world(c.position + metres * c.direction))},
            {"vfov", std::round(c.vfov * kDegree)}}},
          {"light",
           {{"spot",
             {{"position", place(world(l.position))},
              {"target", place(world(l.position + reach * l.direction))},
              {"fov", std::round(l.fov * kDegree)},
              {"intensity", std::stod(fmt::format("{:.2g}", l.power.x))}}}}}};
}

Json SceneWriter::scenery() const {
  const glm::dvec3 low = world(geometry_.bounds_min), high = world(geometry_.bounds_max), side = high - low;
  const double size = std::max({side.x, side.y, side.z, 1e-6 * glm::length(side)});
  const double gap = 0.35 * size, x0 = low.x - gap, z0 = low.z - gap, y0 = low.y - 0.005 * size;
  const double x1 = high.x + 0.9 * size, z1 = high.z + 0.9 * size, y1 = high.y + 0.6 * size;
  const auto at = [&](double x, double y, double z) {
    return glm::dvec3(rounded(x, decimals_), rounded(y, decimals_), rounded(z, decimals_));
  };
  const glm::dvec3 corner = at(x0, y0, z0), far = at(x1, y1, z1), reach = far - corner;
  const auto along = [&](int axis) {
    glm::dvec3 v(0);
    v[axis] = rounded(reach[axis], decimals_);
    return v;
  };
  const glm::dvec3 grey(0.7), red(0.65, 0.25, 0.2);
  return Json::array({quad("floor", corner, along(2), along(0), grey),
                      quad("back wall", corner, along(0), along(1), grey),
                      quad("side wall", corner, along(1), along(2), red)});
}

Json SceneWriter::about(const std::vector<std::string>& notes) const {
  Json materials = Json::array();
  std::set<uint32_t> used(geometry_.triangle_material.begin(), geometry_.triangle_material.end());
  for (const uint32_t i : used) {
    if (materials.size() == kMostMaterials) break;
    const Material& m = geometry_.materials[i];
    materials.push_back(
        {{"name", m.name},
         {"base_color", {rounded(m.base_color.x, 4), rounded(m.base_color.y, 4), rounded(m.base_color.z, 4)}},
         {"metallic", rounded(m.metallic, 4)},
         {"roughness", rounded(m.roughness, 4)},
         {"textured", m.base_color_texture >= 0}});
  }
  return {{"triangles", geometry_.triangles.size()},
          {"unit", "1 length unit is 1 m, as glTF has it; change `unit` if the file's is another"},
          {"bounds", {place(world(geometry_.bounds_min)), place(world(geometry_.bounds_max))}},
          {"materials", materials},
          {"notes", notes}};
}

}  // namespace vsglbench
