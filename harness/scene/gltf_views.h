// Cameras and lights of a glTF file (glTF 2.0, 3.10; KHR_lights_punctual).
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vsglbench {

// In the file's world space and units, as a scene.json has them. Unit directions, orthogonal.
struct GltfCamera {
  std::string name;
  glm::dvec3 eye{0}, direction{0, 0, -1}, up{0, 1, 0};
  double vfov = 45;  // degrees
};

struct GltfLight {
  enum class Type { spot, sun, point };
  std::string name;
  Type type = Type::spot;
  glm::dvec3 position{0}, direction{0, 0, -1}, up{0, 1, 0};
  double fov = 60;                        // spot: degrees, of the square round its cone
  glm::dvec3 power{1};                    // spot and point: W/sr; sun: W/m²
  std::optional<glm::dvec2> half_extent;  // sun: of the rectangle that this programme has exported
};

struct GltfViews {
  std::vector<GltfCamera> cameras;
  std::vector<GltfLight> lights;
  std::vector<std::string> notes;  // what is left out, one line each
};

// A lumen of the file's lights, in candela and lux, is 1/683 W.
inline constexpr double kLumensAWatt = 683;

// Of the nodes that load_gltf() takes its meshes from. A spot's square frustum holds its outer cone, with
// constant intensity; inner cones and ranges are not read. Throws Error(scene).
GltfViews gltf_views(const std::filesystem::path& path);

}  // namespace vsglbench
