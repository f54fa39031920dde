// How a scene moves: data only, in a Scene's `animation`. animation.h poses a scene by it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/track.h"

namespace vsglbench {

// world(t) = world(parent) * fixed * translation(t) * rotation(t) * scale(t), in length units of the file
// that the node is from.
struct MovingNode {
  std::string name;
  int parent = -1;  // in Animation::nodes, where it stands before its children; -1: none
  glm::dmat4 fixed{1};
  Track<glm::dvec3> translation{glm::dvec3(0)};
  Track<glm::dquat> rotation{glm::dquat(1, 0, 0, 0)};
  Track<glm::dvec3> scale{glm::dvec3(1)};
};

struct Extent {
  glm::vec3 low, high;  // metres, relative to Scene::origin
};

// Geometry of one material that moves with a node. Its vertices and triangles are its own, and lie behind all
// that stands still: objects follow each other without gaps to the ends of the scene's arrays, and each is a
// batch.
struct MovingObject {
  std::string name;
  uint32_t node = 0;  // of Animation::nodes
  double unit = 1;    // metres per length unit of the node
  uint32_t first_vertex = 0, vertex_count = 0, first_triangle = 0, triangle_count = 0;
  // One a vertex, in the node's coordinates.
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec4> tangents;
  std::vector<Extent> extents;  // one a frame
};

// Where a camera or light stands and looks, in length units of its view, without the scene's offset.
struct AimMotion {
  double unit = 1;                      // metres
  Track<glm::dvec3> position, aim, up;  // up need not be orthogonal
  bool at_target = false;               // whether `aim` is a point or a direction
};

struct CameraMotion {
  AimMotion aim;
  Track<double> vfov;  // degrees
};

struct LightMotion {
  AimMotion aim;
  bool sun = false;
  Track<glm::dvec3> power;  // spot: intensity where a length unit is a metre; sun: irradiance
  Track<double> fov;        // spot: degrees
  // sun: of its rectangle, in length units; nothing: the smallest rectangle round all that stands still
  // (round all there is at first, where nothing does).
  std::optional<glm::dvec2> half_extent;
};

// What differs between two poses of a scene. `objects`: indices into Animation::objects, ascending, of those
// with a vertex, normal or tangent that differs.
struct Moved {
  bool light = false, camera = false;
  std::vector<uint32_t> objects;

  bool any() const { return light || camera || !objects.empty(); }
};

struct Animation {
  uint32_t frames = 0;  // 0: a still scene, which has one frame, and whose objects stand
  double rate = 24;     // frames a second; frame t is at time t / rate
  std::vector<MovingNode> nodes;
  std::vector<MovingObject> objects;
  std::optional<CameraMotion> camera;  // only of one that is keyed, and so the light
  std::optional<LightMotion> light;
  // Whatever differs between two frames: all that set_frame() returns of them.
  Moved moves;
  // Of a sun, the place on its rectangle that it was given, before fit_depth_ranges() moves it back by how
  // far the objects get in all frames.
  std::optional<glm::vec3> sun_place;
};

}  // namespace vsglbench
