// 16 pixels that are connected to the same x1, so that one packet of shadow rays serves them all.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "reference/footprint.h"
#include "reference/tracer.h"

namespace vsglbench {

// Every second pixel, both ways, of a block of 8x8: neighbours in the image belong to different groups and so
// share no x1 (Keller and Heidrich 2001, "Interleaved Sampling"). Structure of arrays.
struct alignas(64) ReceiverGroup {
  static constexpr uint32_t width = SegmentPacket::width;
  static constexpr uint32_t block = 8, groups = 4;  // a block has `groups` of them

  float position[3][width], ray_origin[3][width];
  float normal[3][width], geometric_normal[3][width];  // zero in a lane without a surface
  uint32_t pixel[width];
  uint32_t lanes = 0;  // bit i: lane i sees a surface
};

// Group `group` of the block whose first pixel is (x, y); pixels past the image's edge have no surface.
ReceiverGroup make_receiver_group(const std::vector<Footprint>& footprints, uint32_t width, uint32_t height,
                                  uint32_t x, uint32_t y, uint32_t group);

// A point as a group sees it: its ray starts at `ray_origin`, and both its normals must face a lane.
struct GroupTarget {
  glm::vec3 position, ray_origin, normal, geometric_normal;
};

// Segments from the group's pixels to the target; a lane is off unless both normals of both ends face the
// other end. Returns the lanes that are on.
uint32_t aim(const ReceiverGroup& group, const GroupTarget& target, SegmentPacket* packet);

}  // namespace vsglbench
