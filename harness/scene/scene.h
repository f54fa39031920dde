// What the programme knows of a scene: flat arrays, in metres, linear Rec.709, SI radiometry.
//
// Conventions that the rasteriser (frame/), the ray tracer (reference/) and the builders all share:
//  * Positions are float offsets from `origin` (double), so that a scene far from the world origin keeps
//    its digits. Light and camera positions are relative to `origin` too.
//  * Right-handed, Y up. UV origin at the image's first row (glTF).
//  * Every surface is two-sided and opaque, but for alpha-masked texels, which are holes.
//  * Textures are read at their finest level with bilinear filtering and repeat addressing on every
//    path: a surface is one function of position, whoever looks at it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/motion.h"
#include "scene/region.h"

namespace vsglbench {

// 8-bit RGBA, row-major, first row first. `srgb`: RGB is sRGB-encoded (decode each texel, then filter).
struct Texture {
  std::string name;
  uint32_t width = 0, height = 0;
  bool srgb = false;
  std::vector<uint8_t> rgba;
};

// Lambert + one microfacet lobe. With the texture-modulated base colour c, metallic m, roughness q:
//   diffuse reflectance  Rd = c (1-m) (1 - 0.04 specular)
//   normal reflectance   F0 = specular * mix(0.04, c, m),  F90 = min(1, 50 max(F0))
//   normal distribution  GGX with alpha = max(q^2, 1e-3), or Phong with phong_exponent where that is > 0
struct Material {
  std::string name;
  glm::vec4 base_color{0.8f, 0.8f, 0.8f, 1.0f};  // linear; w is alpha
  float metallic = 0, roughness = 1;
  float phong_exponent = 0;  // > 0 replaces GGX; at most 1e7
  float specular = 1;        // 0 makes the material purely Lambertian
  int base_color_texture = -1, metallic_roughness_texture = -1, normal_texture = -1;  // indices or -1
  float normal_scale = 1;
  float alpha_cutoff = -1;   // >= 0: texels with alpha below it are holes (glTF MASK)
  bool double_sided = true;  // recorded only; see above
};

// Triangles [first_triangle, first_triangle + triangle_count) share a material.
struct Batch {
  uint32_t first_triangle = 0, triangle_count = 0, material = 0;
};

// A spot lights a square frustum with constant radiant intensity (W/sr per channel); a directional light
// lights a rectangle (orthographic) with irradiance (W/m^2 on a plane facing it).
struct Light {
  enum class Type { spot, directional };
  Type type = Type::spot;
  glm::vec3 position{0};  // spot: apex; directional: centre of the lit rectangle's near side
  glm::vec3 direction{0, -1, 0}, up{0, 0, 1};  // unit, orthogonal
  float fov = 0.8f;                            // spot: full angle of the square frustum, radians
  glm::vec2 half_extent{1, 1};                 // directional: half width and height of the rectangle, metres
  float near = 0.01f, far = 1000;  // along `direction`, for the rasteriser only; geometry lies between
  glm::vec3 power{1};              // spot: intensity; directional: irradiance
};

struct Camera {
  glm::vec3 position{0}, direction{0, 0, -1}, up{0, 1, 0};  // unit, orthogonal
  float vfov = 0.8f;                                        // radians
  float near = 0.01f, far = 1000;
};

struct Scene {
  std::string name;  // "cornell", or "colonnade:cut" with a view
  glm::dvec3 origin{0};
  // Moves everything, in metres: added in double to all geometry, lights and cameras as they are read, before
  // they become offsets from `origin`.
  glm::dvec3 offset{0};
  std::vector<glm::vec3> positions, normals;  // one a vertex; normals are unit
  std::vector<glm::vec4> tangents;            // xyz unit, w = ±1: bitangent = w cross(normal, tangent)
  std::vector<glm::vec2> uvs;
  std::vector<glm::uvec3> triangles;        // counter-clockwise from outside (used for nothing but facing)
  std::vector<Batch> batches;               // ordered by first_triangle; cover all triangles
  std::vector<uint32_t> triangle_material;  // one a triangle
  std::vector<Material> materials;
  std::vector<Texture> textures;
  glm::vec3 bounds_min{0}, bounds_max{0};  // of all frames
  Light light;
  Camera camera;
  std::optional<Region> region;       // of the view, where errors are told by themselves
  Animation animation;                // how the above moves; set_frame() poses it
  std::vector<std::string> warnings;  // what was ignored or repaired, one line each
  std::string hash;                   // content hash of what determines radiance in the present frame

  float diagonal() const { return glm::length(bounds_max - bounds_min); }
};

}  // namespace vsglbench
