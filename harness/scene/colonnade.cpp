// A two-storey arcade round a court, about 262,000 triangles: the load of Crytek's Sponza without a download,
// for the textured views of [VSGL14 Fig. 5] and the columns of [MFIS16 Fig. 7]. Metres; the court spans x
// -10…10, z -5…5, the aisles round it are 3 m wide, the floor lies at y = 0.
#include <array>
#include <cmath>

#include "scene/builders.h"
#include "scene/colonnade_parts.h"
#include "scene/colonnade_textures.h"
#include "scene/shapes.h"

namespace vsglbench {
namespace {

constexpr double kHalfX = 10, kHalfZ = 5;  // court
constexpr double kAisle = 3;               // from the arcade's middle plane to the outer wall
constexpr double kOuterX = kHalfX + kAisle, kOuterZ = kHalfZ + kAisle;
constexpr int kBaysX = 8, kBaysZ = 4;         // of kBayWidth each
constexpr double kStorey = 4.5, kSlab = 0.3;  // clear height, and thickness of gallery and roof
constexpr double kOverhang = 0.35;            // of a slab over the arcade's middle plane
constexpr double kHeight = 2 * (kStorey + kSlab);

enum MaterialId { kFloor, kWall, kStone, kPlaster, kRed, kGreen, kBlue, kMaterialCount };
using Meshes = std::array<Mesh, kMaterialCount>;

// --- Materials --------------------------------------------------------------------------------------------

Material textured(const char* name, int texture_pair, float roughness, const glm::vec3& tint = glm::vec3(1)) {
  Material m;
  m.name = name;
  m.base_color = glm::vec4(tint, 1);
  m.roughness = roughness;
  if (texture_pair >= 0) {
    m.base_color_texture = 2 * texture_pair;
    m.normal_texture = 2 * texture_pair + 1;
  }
  return m;
}

void add_materials(uint32_t texture_size, float floor_exponent, Scene* scene) {
  for (const auto make : {tile_textures, ashlar_textures, stone_textures, weave_textures}) {
    TexturePair pair = make(texture_size);
    scene->textures.push_back(std::move(pair.color));
    scene->textures.push_back(std::move(pair.normal));
  }
  scene->materials = {textured("floor", 0, 0.2f),
                      textured("wall", 1, 0.8f),
                      textured("stone", 2, 0.6f),
                      textured("plaster", -1, 0.9f, {0.75f, 0.72f, 0.66f}),
                      textured("cloth red", 3, 0.9f, {0.65f, 0.06f, 0.05f}),
                      textured("cloth green", 3, 0.9f, {0.10f, 0.40f, 0.08f}),
                      textured("cloth blue", 3, 0.9f, {0.07f, 0.12f, 0.55f})};
  // Polished marble with a metallic share, so that its lobe carries energy at normal incidence too.
  scene->materials[kFloor].phong_exponent = floor_exponent;
  scene->materials[kFloor].metallic = 0.2f;
}

// --- Shell ------------------------------------------------------------------------------------------------

// Calls f(quarter_turns, length, distance, bays) for the four sides; a part made for the side at z =
// +distance belongs there after the turn.
template <class F>
void for_each_side(const F& f) {
  f(0, kHalfX, kHalfZ, kBaysX);
  f(1, kHalfZ, kHalfX, kBaysZ);
  f(2, kHalfX, kHalfZ, kBaysX);
  f(3, kHalfZ, kHalfX, kBaysZ);
}

// A slab over the aisles: plaster below, `top` above, stone edges towards the court.
void add_slab(double y, MaterialId top, Meshes* meshes) {
  for_each_side([&](int turns, double half, double distance, int bays) {
    // The two long sides take the corners.
    const double reach = turns % 2 == 0 ? half + kAisle : half - kOverhang;
    const double inner = distance - kOverhang, outer = distance + kAisle;
    Mesh below, above, edge;
    add_grid(&below, {-reach, y, inner}, {2 * reach, 0, 0}, {0, 0, outer - inner}, 2 * bays, 3, kTile);
    add_grid(&above, {-reach, y + kSlab, outer}, {2 * reach, 0, 0}, {0, 0, inner - outer}, 2 * bays, 3,
             kTile);
    const double edge_reach = half - kOverhang;
    add_grid(&edge, {edge_reach, y, inner}, {-2 * edge_reach, 0, 0}, {0, kSlab, 0}, 2 * bays, 1, kTile);
    place(below, turns, glm::dvec3(0), &(*meshes)[kPlaster]);
    place(above, turns, glm::dvec3(0), &(*meshes)[top]);
    place(edge, turns, glm::dvec3(0), &(*meshes)[kStone]);
  });
}

// Outer wall with a pilaster and, over each aisle, a beam at every column.
void add_outer_wall(Meshes* meshes) {
  for_each_side([&](int turns, double half, double distance, int bays) {
    const double reach = half + kAisle, outer = distance + kAisle;
    Mesh wall, relief;
    add_grid(&wall, {reach, 0, outer}, {-2 * reach, 0, 0}, {0, kHeight, 0}, 2 * bays, 8, kTile);
    for (int i = 0; i <= bays; ++i) {
      const double x = -half + i * kBayWidth;
      add_box(&relief, {x - 0.25, 0, outer - 0.15}, {x + 0.25, kHeight, outer}, kTile);
      for (const double top : {kStorey, kHeight - kSlab}) {
        add_box(&relief, {x - 0.17, top - 0.3, distance + 0.2}, {x + 0.17, top, outer}, kTile);
      }
    }
    place(wall, turns, glm::dvec3(0), &(*meshes)[kWall]);
    place(relief, turns, glm::dvec3(0), &(*meshes)[kStone]);
  });
}

void add_ground(Meshes* meshes) {
  add_grid(&(*meshes)[kFloor], {-kOuterX, 0, kOuterZ}, {2 * kOuterX, 0, 0}, {0, 0, -2 * kOuterZ}, 52, 32,
           kTile);
}

// --- Arcade -----------------------------------------------------------------------------------------------

// Column positions along a side; the corner columns belong to the long sides.
void add_columns(const Mesh& column, double y, Meshes* meshes) {
  for_each_side([&](int turns, double half, double distance, int bays) {
    const int corner = turns % 2 == 0 ? 0 : 1;
    for (int i = corner; i <= bays - corner; ++i) {
      Mesh moved;
      place(column, 0, {-half + i * kBayWidth, y, distance}, &moved);
      place(moved, turns, glm::dvec3(0), &(*meshes)[kStone]);
    }
  });
}

void add_bays(const Mesh& wall, const Mesh& stone, double y, Meshes* meshes) {
  for_each_side([&](int turns, double half, double distance, int bays) {
    for (int i = 0; i < bays; ++i) {
      const glm::dvec3 centre(-half + (i + 0.5) * kBayWidth, y, distance);
      Mesh moved_wall, moved_stone;
      place(wall, 0, centre, &moved_wall);
      place(stone, 0, centre, &moved_stone);
      place(moved_wall, turns, glm::dvec3(0), &(*meshes)[kWall]);
      place(moved_stone, turns, glm::dvec3(0), &(*meshes)[kStone]);
    }
  });
  // A pier closes each corner above the column; a little proud, so that no faces coincide.
  for (const double x : {-kHalfX, kHalfX}) {
    for (const double z : {-kHalfZ, kHalfZ}) {
      const double w = 0.5 * kWallThickness + 0.02;
      add_box(&(*meshes)[kStone], {x - w, y + kSpring, z - w}, {x + w, y + kStorey, z + w}, kTile);
    }
  }
}

// Coloured cloths behind every second arch of the ground floor.
void add_cloths(int cells, Meshes* meshes) {
  const MaterialId colors[] = {kRed, kGreen, kBlue};
  int next = 0;
  for_each_side([&](int turns, double half, double distance, int bays) {
    for (int i = 1; i < bays; i += 2) {
      const MaterialId color = colors[next++ % 3];
      Mesh cloth = arch_cloth(cells, next), moved;
      place(cloth, 0, {-half + (i + 0.5) * kBayWidth, 0, distance + 0.35}, &moved);
      place(moved, turns, glm::dvec3(0), &(*meshes)[color]);
    }
  });
}

}  // namespace

void build_colonnade(const Json& parameters, Scene* scene) {
  const std::vector<double> p = read_parameters(parameters, {{"texture_size", 512, 16, 4096},
                                                             {"floor_phong_exponent", 1023, 1, 1e7},
                                                             {"column_segments", 22, 3, 512},
                                                             {"cloth_cells", 30, 1, 512}});
  add_materials(static_cast<uint32_t>(p[0]), static_cast<float>(p[1]), scene);
  const Mesh column = arcade_column(static_cast<int>(p[2]));
  Meshes meshes;
  add_ground(&meshes);
  add_outer_wall(&meshes);
  for (int storey = 0; storey < 2; ++storey) {
    const double y = storey * (kStorey + kSlab);
    Mesh wall, stone;
    add_arch(kStorey, &wall, &stone);
    if (storey == 1) add_balustrade(&stone);
    add_bays(wall, stone, y, &meshes);
    add_columns(column, y, &meshes);
    add_slab(y + kStorey, storey == 0 ? kFloor : kPlaster, &meshes);
  }
  add_cloths(static_cast<int>(p[3]), &meshes);
  MeshCollector collector(scene);
  for (uint32_t m = 0; m < kMaterialCount; ++m) collector.add(std::move(meshes[m]), m);
  collector.finish();
}

}  // namespace vsglbench
