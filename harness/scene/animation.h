// A scene in motion: its frames, and its pose in each of them. The arrays of a Scene always hold one pose,
// which whoever draws or traces it reads.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/mesh.h"
#include "scene/scene.h"

namespace vsglbench {

// Whether two vectors, cameras or lights have the same bits.
template <class T>
bool same_bits(const T& a, const T& b) {
  using Bits = std::array<uint32_t, sizeof(T) / 4>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}
static_assert(sizeof(Camera) == 4 * 12 && sizeof(Light) == 4 * 18, "same_bits would read padding");

// 1 of a still scene.
inline uint32_t frame_count(const Scene& scene) {
  return scene.animation.frames > 0 ? scene.animation.frames : 1;
}
// Seconds. std::logic_error for a frame that is none.
double frame_time(const Scene& scene, uint32_t frame);

// Poses the scene in a frame: writes positions, normals and tangents of its moving objects, light, camera and
// hash, and nothing else; bounds and diagonal() are those of all frames. Returns what now differs to the bit
// from the pose before; whatever frame that was, the new pose is the same to the bit. The hash is that of the
// pose (scene_hash), whatever the other frames are. std::logic_error for a frame that is none.
Moved set_frame(Scene* scene, uint32_t frame);

// Triangles and vertices before those of moving objects.
size_t still_triangles(const Scene& scene);
size_t still_vertices(const Scene& scene);

// Appends an object in no pose yet: `object` says its name, node and unit, `mesh` its geometry in the node's
// coordinates, whose tangents are made where it has none. Zero-area triangles are kept, with a warning.
void add_object(Scene* scene, MovingObject object, Mesh mesh, uint32_t material);

// World transforms of all nodes at a time, in the nodes' units. Error(scene) where one is not finite.
std::vector<glm::dmat4> world_transforms(const Animation& animation, double time);

// Poses all frames once: fills the objects' extents and animation.moves.objects, widens the bounds to all
// frames, and leaves the scene in frame 0. To be called when all objects are there. Error(scene), "at frame
// T, ...", for an object that is nowhere or further off than 1e18 m, and for more vertices in all frames
// together than can be looked at.
void measure_motion(Scene* scene);

}  // namespace vsglbench
