// Shapes that builders put scenes together from. uvs are metres divided by `tile`; normals point outwards.
#pragma once

#include <span>
#include <vector>

#include "base/json.h"
#include "scene/mesh.h"

namespace vsglbench {

// nu x nv quads over origin + [0,1] u + [0,1] v; the normal is along cross(u, v). u runs along the texture's
// u, v up the image.
void add_grid(Mesh* mesh, const glm::dvec3& origin, const glm::dvec3& u, const glm::dvec3& v, int nu, int nv,
              double tile);

// The six sides of an axis-aligned box, one quad each.
void add_box(Mesh* mesh, const glm::dvec3& low, const glm::dvec3& high, double tile);

// A profile of (radius, height) points, from the bottom up, turned about the vertical axis through `base`. A
// point that stands twice is a crease.
void add_lathe(Mesh* mesh, const glm::dvec3& base, std::span<const glm::dvec2> profile, int segments,
               double tile);

// A ring round the origin in the plane y = 0: a tube of radius `minor`, of `sides` sides, along a circle of
// radius `major`, of `segments` segments; 2 * segments * sides triangles. u runs once round the ring, v once
// round the tube.
void add_torus(Mesh* mesh, double major, double minor, int segments, int sides);

// Appends `part`, turned about the vertical axis by quarter turns (x to -z) and moved.
void place(const Mesh& part, int quarter_turns, const glm::dvec3& offset, Mesh* mesh);

// A number that a builder takes from its JSON parameters.
struct NumberParameter {
  const char* name;
  double standard, low, high;
};
// The values in the order of `known`. Error(scene) for an unknown key, a value that is no number, or one out
// of range.
std::vector<double> read_parameters(const Json& json, const std::vector<NumberParameter>& known);

}  // namespace vsglbench
