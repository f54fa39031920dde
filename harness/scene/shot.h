// What a camera and a light make of a scene, told by rays before anything is rendered: is light seen, and
// does any of it come back?
#pragma once

#include <cstdint>

#include "scene/triangle_tree.h"
#include "scene/view.h"

namespace vsglbench {

// A camera and a light, from the scene's origin, in metres.
struct Shot {
  Camera camera;
  Light light;
};

// Shares, from 0 to 1, of points that lie evenly over the image and over the light's square.
struct ShotMeasure {
  double seen = 0;            // of the image: where there is a surface
  double subject = 0;         // of the seen points: on triangles before `subject_triangles`
  double lit = 0;             // of the light's square: where there is a surface
  double lit_seen = 0;        // of the lit points: those that the camera sees
  double direct = 0;          // of the seen points: those that the light sees
  double subject_direct = 0;  // of the seen points on such triangles: those that the light sees
  double reached = 0;   // of the seen points: those that at least one of `links` lit points sends light to
  double strength = 0;  // mean irradiance of indirect light over the mean of direct light, on seen points
  double nearest = 0;   // metres from the light to the tenth of lit points that are nearest to it
  double depth = 0;     // the median distance of seen points from the camera, metres
};

struct ShotRays {
  uint32_t image = 10, light = 10;  // points along an edge
  uint32_t links = 4;               // lit points that each seen point is linked with
  float aspect = 16.0f / 9;         // of the image
  uint32_t subject_triangles = ~0u;
};

// A point of a surface, and its face's normal on the side that it was seen from.
struct ShotPoint {
  glm::vec3 position{0}, normal{0};
  float reflectance = 0;  // luminance of its diffuse reflectance and F0, at most 1
  uint32_t triangle = 0;
  float distance = 0;  // from the viewer
  bool front = true;   // whether its corners run counter-clockwise from there, as from a solid's outside
};

// What a camera sees in a picture `aspect` times as wide as high.
View view_of(const Camera& camera, float aspect = 16.0f / 9);

// Whether a view sees a point: inside of its frame, and nothing before it.
bool sees(const TriangleTree& tree, const View& view, const glm::vec3& point);

// Points that a view sees through one place each of `across` × `down` cells of its image; cells without a
// surface are left out.
std::vector<ShotPoint> points_seen(const TriangleTree& tree, const View& view, uint32_t across,
                                   uint32_t down);

// Deterministic: no random number, the same on every machine but for rounding.
ShotMeasure measure_shot(const TriangleTree& tree, const Shot& shot, const ShotRays& rays = {});
// The same of a camera whose points are known already.
ShotMeasure measure_shot(const TriangleTree& tree, const Shot& shot, const std::vector<ShotPoint>& seen,
                         const ShotRays& rays);

}  // namespace vsglbench
