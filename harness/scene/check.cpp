#include "scene/check.h"

#include <cmath>

#include "base/error.h"
#include "base/hash.h"
#include "scene/motion_check.h"

namespace vsglbench {
namespace {

bool finite(const glm::vec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }
bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool unit(const glm::vec3& v) { return std::abs(glm::length(v) - 1) < 1e-3f; }

template <class... Args>
void require(bool condition, const Scene& scene, fmt::format_string<Args...> format, Args&&... args) {
  if (condition) return;
  throw fail(ErrorKind::scene, "scene {}: {}", scene.name, fmt::format(format, std::forward<Args>(args)...));
}

void check_vertices(const Scene& scene) {
  const size_t n = scene.positions.size();
  require(n < 0x80000000u, scene, "{} vertices are too many", n);
  require(scene.normals.size() == n && scene.tangents.size() == n && scene.uvs.size() == n, scene,
          "{} positions but {} normals, {} tangents, {} uvs", n, scene.normals.size(), scene.tangents.size(),
          scene.uvs.size());
  for (size_t i = 0; i < n; ++i) {
    require(finite(scene.positions[i]), scene, "vertex {}: position is not finite", i);
    require(unit(scene.normals[i]), scene, "vertex {}: normal is not of length 1", i);
    require(unit(glm::vec3(scene.tangents[i])) && std::abs(scene.tangents[i].w) == 1, scene,
            "vertex {}: tangent is not of length 1 with w = ±1", i);
    require(finite(scene.uvs[i]), scene, "vertex {}: uv is not finite", i);
  }
}

void check_triangles(const Scene& scene) {
  require(!scene.triangles.empty(), scene, "no triangles");
  require(scene.triangle_material.size() == scene.triangles.size(), scene,
          "{} triangles but {} material indices", scene.triangles.size(), scene.triangle_material.size());
  for (size_t i = 0; i < scene.triangles.size(); ++i) {
    const glm::uvec3& t = scene.triangles[i];
    require(std::max(t.x, std::max(t.y, t.z)) < scene.positions.size(), scene,
            "triangle {}: index past the {} vertices", i, scene.positions.size());
  }
  // Batches follow each other without gaps, and agree with triangle_material.
  size_t next = 0;
  for (size_t i = 0; i < scene.batches.size(); ++i) {
    const Batch& batch = scene.batches[i];
    require(batch.first_triangle == next && batch.triangle_count <= scene.triangles.size() - next, scene,
            "batch {}: does not continue at triangle {}", i, next);
    require(batch.material < scene.materials.size(), scene, "batch {}: no material {}", i, batch.material);
    for (uint32_t k = 0; k < batch.triangle_count; ++k) {
      require(scene.triangle_material[next + k] == batch.material, scene,
              "triangle {}: material {} is not its batch's", next + k, scene.triangle_material[next + k]);
    }
    next += batch.triangle_count;
  }
  require(next == scene.triangles.size(), scene, "batches cover {} of {} triangles", next,
          scene.triangles.size());
}

void check_materials(const Scene& scene) {
  const auto in_range = [](float v, float low, float high) {
    return v >= low && v <= high;
  };  // false for NaN
  for (const Material& m : scene.materials) {
    for (int k = 0; k < 4; ++k) {
      require(in_range(m.base_color[k], 0, 1), scene, "material {}: base colour outside 0…1", m.name);
    }
    require(in_range(m.metallic, 0, 1) && in_range(m.roughness, 0, 1), scene,
            "material {}: metallic or roughness outside 0…1", m.name);
    require(in_range(m.phong_exponent, 0, 1e7f), scene, "material {}: Phong exponent outside 0…1e7", m.name);
    require(in_range(m.specular, 0, 1), scene, "material {}: specular outside 0…1", m.name);
    require(std::isfinite(m.normal_scale) && std::isfinite(m.alpha_cutoff), scene,
            "material {}: normal scale or alpha cutoff is not finite", m.name);
    for (const int t : {m.base_color_texture, m.metallic_roughness_texture, m.normal_texture}) {
      require(t >= -1 && t < static_cast<int>(scene.textures.size()), scene, "material {}: no texture {}",
              m.name, t);
    }
  }
  for (const Texture& t : scene.textures) {
    require(t.width > 0 && t.height > 0 && t.rgba.size() == size_t(4) * t.width * t.height, scene,
            "texture {}: {} bytes are not {}x{} texels", t.name, t.rgba.size(), t.width, t.height);
  }
}

void check_frame(const Scene& scene, const char* what, const glm::vec3& position, const glm::vec3& direction,
                 const glm::vec3& up, float near, float far) {
  require(finite(position), scene, "the {}'s position is not finite", what);
  require(unit(direction) && unit(up) && std::abs(glm::dot(direction, up)) < 1e-3f, scene,
          "the {}'s direction and up are not orthogonal unit vectors", what);
  require(std::isfinite(far) && near > 0 && far > near, scene, "the {}'s near {} and far {} are no range",
          what, near, far);
}

void check_light_and_camera(const Scene& scene) {
  constexpr float kPi = 3.14159265f;
  const Light& l = scene.light;
  const Camera& c = scene.camera;
  check_frame(scene, "light", l.position, l.direction, l.up, l.near, l.far);
  check_frame(scene, "camera", c.position, c.direction, c.up, c.near, c.far);
  require(l.fov > 0 && l.fov < kPi, scene, "the light's field of view {} rad is outside 0…pi", l.fov);
  require(c.vfov > 0 && c.vfov < kPi, scene, "the camera's field of view {} rad is outside 0…pi", c.vfov);
  require(finite(l.half_extent) && l.half_extent.x > 0 && l.half_extent.y > 0, scene,
          "the light's half extent is not positive");
  require(finite(l.power) && glm::all(glm::greaterThanEqual(l.power, glm::vec3(0))), scene,
          "the light's power is negative or not finite");
}

}  // namespace

void check_scene(const Scene& scene) {
  check_vertices(scene);
  check_triangles(scene);
  check_materials(scene);
  check_light_and_camera(scene);
  check_motion(scene);
}

std::string scene_hash(const Scene& scene) {
  Hasher h;
  h.text("vsglbench.scene/1");
  h.array(scene.positions).array(scene.normals).array(scene.tangents).array(scene.uvs).array(scene.triangles);
  h.array(scene.triangle_material);
  for (const Material& m : scene.materials) {
    for (const float v : {m.base_color.x, m.base_color.y, m.base_color.z, m.base_color.w, m.metallic,
                          m.roughness, m.phong_exponent, m.specular, m.normal_scale, m.alpha_cutoff}) {
      h.value(v);
    }
    h.value(m.base_color_texture).value(m.metallic_roughness_texture).value(m.normal_texture);
  }
  for (const Texture& t : scene.textures) h.value(t.width).value(t.height).value(t.srgb).array(t.rgba);
  const auto vector = [&h](const auto& v) {
    for (int k = 0; k < v.length(); ++k) h.value(v[k]);
  };
  const Light& l = scene.light;
  h.value(l.type);
  // How far a sun is moved back says how far objects get in other frames.
  vector(scene.animation.sun_place.value_or(l.position)), vector(l.direction), vector(l.up),
      vector(l.half_extent), vector(l.power);
  h.value(l.fov);
  const Camera& c = scene.camera;
  vector(c.position), vector(c.direction), vector(c.up);
  h.value(c.vfov);
  return h.hex();
}

}  // namespace vsglbench
