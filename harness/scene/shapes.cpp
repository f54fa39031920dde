#include "scene/shapes.h"

#include <cmath>
#include <numbers>

#include "base/nearest.h"

namespace vsglbench {
namespace {

// Outward normals of one smooth run of a profile, in the (radius, height) plane.
std::vector<glm::dvec2> profile_normals(std::span<const glm::dvec2> run) {
  std::vector<glm::dvec2> normals(run.size(), glm::dvec2(0));
  for (size_t i = 0; i + 1 < run.size(); ++i) {
    const glm::dvec2 d = glm::normalize(run[i + 1] - run[i]);
    normals[i] += glm::dvec2(d.y, -d.x);
    normals[i + 1] += glm::dvec2(d.y, -d.x);
  }
  for (glm::dvec2& n : normals) n = glm::normalize(n);
  return normals;
}

void add_smooth_run(Mesh* mesh, const glm::dvec3& base, std::span<const glm::dvec2> run, int segments,
                    double tile) {
  const std::vector<glm::dvec2> normals = profile_normals(run);
  const uint32_t first = static_cast<uint32_t>(mesh->positions.size());
  const double turns =
      std::max(1.0, std::round(2 * std::numbers::pi * run[0].x / tile));  // a seamless texture
  for (size_t i = 0; i < run.size(); ++i) {
    for (int s = 0; s <= segments; ++s) {
      const double angle = 2 * std::numbers::pi * (s % segments) / segments;
      const glm::dvec3 out(std::sin(angle), 0, std::cos(angle));
      mesh->add_vertex(base + run[i].x * out + glm::dvec3(0, run[i].y, 0),
                       glm::vec3(normals[i].x * out + glm::dvec3(0, normals[i].y, 0)),
                       glm::vec2(turns * s / segments, -run[i].y / tile));
    }
  }
  const uint32_t row = static_cast<uint32_t>(segments) + 1;
  for (uint32_t i = 0; i + 1 < run.size(); ++i) {
    for (uint32_t s = 0; s + 1 < row; ++s) {
      const uint32_t a = first + i * row + s, b = a + 1, c = a + row, d = c + 1;
      mesh->triangles.emplace_back(a, b, d);
      mesh->triangles.emplace_back(a, d, c);
    }
  }
}

}  // namespace

void add_grid(Mesh* mesh, const glm::dvec3& origin, const glm::dvec3& u, const glm::dvec3& v, int nu, int nv,
              double tile) {
  const glm::vec3 normal(glm::normalize(glm::cross(u, v)));
  const uint32_t first = static_cast<uint32_t>(mesh->positions.size());
  for (int j = 0; j <= nv; ++j) {
    for (int i = 0; i <= nu; ++i) {
      const double s = double(i) / nu, t = double(j) / nv;
      mesh->add_vertex(origin + s * u + t * v, normal,
                       glm::vec2(s * glm::length(u) / tile, -t * glm::length(v) / tile));
    }
  }
  const uint32_t row = static_cast<uint32_t>(nu) + 1;
  for (uint32_t j = 0; j < static_cast<uint32_t>(nv); ++j) {
    for (uint32_t i = 0; i < static_cast<uint32_t>(nu); ++i) {
      const uint32_t a = first + j * row + i, b = a + 1, c = a + row, d = c + 1;
      mesh->triangles.emplace_back(a, b, d);
      mesh->triangles.emplace_back(a, d, c);
    }
  }
}

void add_box(Mesh* mesh, const glm::dvec3& low, const glm::dvec3& high, double tile) {
  const glm::dvec3 d = high - low, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  add_grid(mesh, low + z, x, y, 1, 1, tile);       // front
  add_grid(mesh, low + x, -x, y, 1, 1, tile);      // back
  add_grid(mesh, low + x + z, -z, y, 1, 1, tile);  // right
  add_grid(mesh, low, z, y, 1, 1, tile);           // left
  add_grid(mesh, low + y + z, x, -z, 1, 1, tile);  // top
  add_grid(mesh, low, x, z, 1, 1, tile);           // bottom
}

void add_lathe(Mesh* mesh, const glm::dvec3& base, std::span<const glm::dvec2> profile, int segments,
               double tile) {
  size_t begin = 0;
  for (size_t i = 1; i <= profile.size(); ++i) {
    const bool crease = i < profile.size() && profile[i] == profile[i - 1];
    if (i < profile.size() && !crease) continue;
    add_smooth_run(mesh, base, profile.subspan(begin, i - begin), segments, tile);
    begin = i;
  }
}

void add_torus(Mesh* mesh, double major, double minor, int segments, int sides) {
  const uint32_t first = static_cast<uint32_t>(mesh->positions.size());
  for (int i = 0; i <= segments; ++i) {
    const double round = 2 * std::numbers::pi * (i % segments) / segments;
    const glm::dvec3 out(std::sin(round), 0, std::cos(round));
    for (int j = 0; j <= sides; ++j) {
      const double angle = 2 * std::numbers::pi * (j % sides) / sides;
      const glm::dvec3 normal = std::cos(angle) * out + glm::dvec3(0, std::sin(angle), 0);
      mesh->add_vertex(major * out + minor * normal, glm::vec3(normal),
                       glm::vec2(double(i) / segments, -double(j) / sides));
    }
  }
  const uint32_t row = static_cast<uint32_t>(sides) + 1;
  for (uint32_t i = 0; i < static_cast<uint32_t>(segments); ++i) {
    for (uint32_t j = 0; j + 1 < row; ++j) {
      const uint32_t a = first + i * row + j, b = a + row, c = a + 1, d = b + 1;
      mesh->triangles.emplace_back(a, b, d);
      mesh->triangles.emplace_back(a, d, c);
    }
  }
}

void place(const Mesh& part, int quarter_turns, const glm::dvec3& offset, Mesh* mesh) {
  const uint32_t first = static_cast<uint32_t>(mesh->positions.size());
  const auto turn = [quarter_turns](auto v) {
    for (int k = 0; k < (quarter_turns % 4 + 4) % 4; ++k) v = decltype(v)(v.z, v.y, -v.x);
    return v;
  };
  for (size_t i = 0; i < part.positions.size(); ++i) {
    mesh->add_vertex(turn(part.positions[i]) + offset, turn(part.normals[i]), part.uvs[i]);
  }
  for (const glm::uvec3& t : part.triangles) mesh->triangles.push_back(t + first);
}

std::vector<double> read_parameters(const Json& json, const std::vector<NumberParameter>& known) {
  std::vector<std::string> names;
  for (const NumberParameter& p : known) names.push_back(p.name);
  for (const auto& [key, unused] : json.items()) {
    if (std::find(names.begin(), names.end(), key) == names.end()) {
      throw fail(ErrorKind::scene, "unknown parameter '{}'{}", key, suggestion(key, names));
    }
  }
  std::vector<double> values;
  for (const NumberParameter& p : known) {
    const Json value = json.value(p.name, Json(p.standard));
    if (!value.is_number() || !(value >= p.low && value <= p.high)) {
      throw fail(ErrorKind::scene, "parameter '{}' is {} but must be a number from {} to {}", p.name,
                 value.dump(), p.low, p.high);
    }
    values.push_back(value.get<double>());
  }
  return values;
}

}  // namespace vsglbench
