// A Cornell box: five walls, open to the front, and two boxes; everything Lambertian.
#include <cmath>

#include "scene/builders.h"
#include "scene/shapes.h"

namespace vsglbench {
namespace {

Material lambert(const char* name, const glm::vec3& color) {
  Material m;
  m.name = name;
  m.base_color = glm::vec4(color, 1);
  m.specular = 0;
  return m;
}

// A box on the floor, turned about the vertical axis; its bottom is left out.
void add_turned_box(Mesh* mesh, const glm::dvec2& centre, const glm::dvec3& size, double degrees) {
  const double angle = glm::radians(degrees);
  const glm::dvec3 x(std::cos(angle), 0, -std::sin(angle)), z(std::sin(angle), 0, std::cos(angle));
  const glm::dvec3 u = size.x * x, v(0, size.y, 0), w = size.z * z;
  const glm::dvec3 low = glm::dvec3(centre.x, 0, centre.y) - 0.5 * u - 0.5 * w;
  add_grid(mesh, low + w, u, v, 1, 1, 1);
  add_grid(mesh, low + u, -u, v, 1, 1, 1);
  add_grid(mesh, low + u + w, -w, v, 1, 1, 1);
  add_grid(mesh, low, w, v, 1, 1, 1);
  add_grid(mesh, low + v + w, u, -w, 1, 1, 1);
}

}  // namespace

void build_cornell(const Json& parameters, Scene* scene) {
  const double s = read_parameters(parameters, {{"size", 2.0, 0.01, 1000}})[0];  // edge of the room, metres
  scene->materials = {lambert("white", {0.73f, 0.73f, 0.73f}), lambert("red", {0.63f, 0.065f, 0.05f}),
                      lambert("green", {0.14f, 0.45f, 0.091f})};
  const glm::dvec3 x(s, 0, 0), y(0, s, 0), z(0, 0, s), corner(-s / 2, 0, -s / 2);
  Mesh white, red, green;
  add_grid(&white, corner + z, x, -z, 1, 1, s);  // floor
  add_grid(&white, corner + y, x, z, 1, 1, s);   // ceiling
  add_grid(&white, corner, x, y, 1, 1, s);       // back
  add_grid(&red, corner + z, -z, y, 1, 1, s);    // left
  add_grid(&green, corner + x, z, y, 1, 1, s);   // right
  add_turned_box(&white, s * glm::dvec2(0.17, 0.17), s * glm::dvec3(0.3, 0.3, 0.3), -17);
  add_turned_box(&white, s * glm::dvec2(-0.17, -0.15), s * glm::dvec3(0.3, 0.6, 0.3), 20);
  MeshCollector collector(scene);
  collector.add(std::move(white), 0);
  collector.add(std::move(red), 1);
  collector.add(std::move(green), 2);
  collector.finish();
}

}  // namespace vsglbench
