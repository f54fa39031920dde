#include "scene/surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/mesh.h"

namespace vsglbench {
namespace {

constexpr float kLeastCosine = 0.01f;  // of the shading normal with the direction to the viewer

// IEC 61966-2-1.
float srgb_to_linear(float s) { return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f); }

const std::array<float, 256>& srgb_table() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (size_t i = 0; i < t.size(); ++i) t[i] = srgb_to_linear(static_cast<float>(i) / 255.0f);
    return t;
  }();
  return table;
}

glm::vec4 texel(const Texture& texture, uint32_t x, uint32_t y) {
  const uint8_t* p = &texture.rgba[4 * (size_t(y) * texture.width + x)];
  const glm::vec4 v = glm::vec4(p[0], p[1], p[2], p[3]) / 255.0f;
  if (!texture.srgb) return v;
  const auto& table = srgb_table();
  return {table[p[0]], table[p[1]], table[p[2]], v.w};
}

uint32_t wrap(int i, uint32_t size) {
  const int n = static_cast<int>(size);
  return static_cast<uint32_t>(((i % n) + n) % n);
}

// Barycentric interpolation of a vertex array.
template <class T>
T interpolate(const std::vector<T>& values, const glm::uvec3& t, const glm::vec2& b) {
  return (1 - b.x - b.y) * values[t.x] + b.x * values[t.y] + b.y * values[t.z];
}

glm::vec3 normalize_or(const glm::vec3& v, const glm::vec3& otherwise) {
  const float length = glm::length(v);
  return length > 1e-12f ? v / length : otherwise;
}

glm::vec4 base_color(const Scene& scene, const Material& material, const glm::vec2& uv) {
  if (material.base_color_texture < 0) return material.base_color;
  return material.base_color * sample_texture(scene.textures[material.base_color_texture], uv);
}

// Face normal from double edges; the interpolated normal where the triangle has no area.
glm::vec3 face_normal(const Scene& scene, const glm::uvec3& t, const glm::vec3& otherwise) {
  const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
  const glm::dvec3 n = glm::cross(b - a, c - a);
  return has_area(a, b, c) ? glm::vec3(glm::normalize(n)) : otherwise;
}

// n = normalize(x t + y b + z n) with the texel's vector 2 texel - 1, its xy times the scale
// (glTF 2.0, 3.9.3).
glm::vec3 map_normal(const Scene& scene, const Material& material, const glm::uvec3& t, const glm::vec2& b,
                     const glm::vec2& uv, const glm::vec3& normal) {
  const glm::vec4 tangent = interpolate(scene.tangents, t, b);
  const glm::vec3 axis = glm::vec3(tangent) - normal * glm::dot(normal, glm::vec3(tangent));
  const float length = glm::length(axis);
  if (!(length > 1e-6f)) return normal;
  const glm::vec3 x = axis / length;
  const glm::vec3 y = (tangent.w < 0 ? -1.0f : 1.0f) * glm::cross(normal, x);
  glm::vec3 m = 2.0f * glm::vec3(sample_texture(scene.textures[material.normal_texture], uv)) - 1.0f;
  m.x *= material.normal_scale;
  m.y *= material.normal_scale;
  return normalize_or(m.x * x + m.y * y + m.z * normal, normal);
}

// Rd, F0 and NDF of a material at uv, as Material says.
void evaluate_material(const Scene& scene, const Material& material, const glm::vec2& uv, Surface* surface) {
  const glm::vec3 c(base_color(scene, material, uv));
  float metallic = material.metallic, roughness = material.roughness;
  if (material.metallic_roughness_texture >= 0) {
    const glm::vec4 mr = sample_texture(scene.textures[material.metallic_roughness_texture], uv);
    roughness *= mr.y;
    metallic *= mr.z;
  }
  surface->diffuse = c * ((1 - metallic) * (1 - 0.04f * material.specular));
  surface->f0 = material.specular * glm::mix(glm::vec3(0.04f), c, metallic);
  surface->ndf =
      material.phong_exponent > 0 ? -material.phong_exponent : std::max(roughness * roughness, 1e-3f);
}

}  // namespace

glm::vec4 sample_texture(const Texture& texture, const glm::vec2& uv) {
  // Texel centres lie at half-integers.
  const glm::vec2 size(texture.width, texture.height);
  const glm::vec2 p = (uv - glm::floor(uv)) * size - 0.5f;
  const glm::vec2 corner = glm::floor(p), f = p - corner;
  const int x = static_cast<int>(corner.x), y = static_cast<int>(corner.y);
  const uint32_t x0 = wrap(x, texture.width), x1 = wrap(x + 1, texture.width);
  const uint32_t y0 = wrap(y, texture.height), y1 = wrap(y + 1, texture.height);
  return glm::mix(glm::mix(texel(texture, x0, y0), texel(texture, x1, y0), f.x),
                  glm::mix(texel(texture, x0, y1), texel(texture, x1, y1), f.x), f.y);
}

bool is_hole(const Scene& scene, uint32_t triangle, const glm::vec2& barycentric) {
  const Material& material = scene.materials[scene.triangle_material[triangle]];
  if (material.alpha_cutoff < 0) return false;
  const glm::vec2 uv = interpolate(scene.uvs, scene.triangles[triangle], barycentric);
  return base_color(scene, material, uv).w < material.alpha_cutoff;
}

Surface surface_at(const Scene& scene, uint32_t triangle, const glm::vec2& barycentric,
                   const glm::vec3& to_viewer) {
  const glm::uvec3& t = scene.triangles[triangle];
  const Material& material = scene.materials[scene.triangle_material[triangle]];
  const glm::vec2 uv = interpolate(scene.uvs, t, barycentric);
  Surface surface;
  surface.position = interpolate(scene.positions, t, barycentric);

  // Geometric normal towards the viewer.
  const glm::vec3 smooth = interpolate(scene.normals, t, barycentric);
  glm::vec3 g = face_normal(scene, t, normalize_or(smooth, scene.normals[t.x]));
  if (glm::dot(g, to_viewer) < 0) g = -g;
  surface.geometric_normal = g;

  // Shading normal: interpolate, map, turn to the geometric side, keep it visible.
  glm::vec3 n = normalize_or(smooth, g);
  if (material.normal_texture >= 0) n = map_normal(scene, material, t, barycentric, uv, n);
  if (glm::dot(n, g) < 0) n = -n;
  const float cosine = glm::dot(n, to_viewer);
  if (cosine < kLeastCosine) n = normalize_or(n + (kLeastCosine - cosine) * to_viewer, g);
  surface.normal = n;

  evaluate_material(scene, material, uv, &surface);
  return surface;
}

}  // namespace vsglbench
