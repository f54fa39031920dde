// A near-mirror metal ring on a matt floor, for caustics [VSGL14 Fig. 4]: 2 + 512 triangles, Phong exponent
// 65535.
#include "scene/builders.h"
#include "scene/shapes.h"

namespace vsglbench {

void build_ring(const Json& parameters, Scene* scene) {
  const std::vector<double> p = read_parameters(parameters, {{"radius", 1.0, 0.01, 1000},
                                                             {"height", 0.5, 0.01, 1000},
                                                             {"floor", 8.0, 0.1, 10000},
                                                             {"segments", 256, 3, 65536},
                                                             {"phong_exponent", 65535, 1, 1e7}});
  const double radius = p[0], height = p[1], floor = p[2];

  Material matt;
  matt.name = "floor";
  matt.base_color = glm::vec4(0.75f, 0.75f, 0.75f, 1);
  matt.specular = 0;
  Material metal;
  metal.name = "ring";
  metal.base_color = glm::vec4(0.92f, 0.78f, 0.45f, 1);
  metal.metallic = 1;
  metal.phong_exponent = static_cast<float>(p[4]);
  scene->materials = {matt, metal};

  Mesh plane, ring;
  add_grid(&plane, {-floor / 2, 0, floor / 2}, {floor, 0, 0}, {0, 0, -floor}, 1, 1, 1);
  const glm::dvec2 profile[] = {{radius, 0}, {radius, height}};
  add_lathe(&ring, glm::dvec3(0), profile, static_cast<int>(p[3]), 1);
  MeshCollector collector(scene);
  collector.add(std::move(plane), 0);
  collector.add(std::move(ring), 1);
  collector.finish();
}

}  // namespace vsglbench
