#include "reference/receiver_group.h"

namespace vsglbench {

ReceiverGroup make_receiver_group(const std::vector<Footprint>& footprints, uint32_t width, uint32_t height,
                                  uint32_t x, uint32_t y, uint32_t group) {
  static const Footprint none;
  ReceiverGroup g;
  for (uint32_t lane = 0; lane < ReceiverGroup::width; ++lane) {
    const uint32_t px = x + lane % 4 * 2 + group % 2, py = y + lane / 4 * 2 + group / 2;
    const bool inside = px < width && py < height;
    g.pixel[lane] = inside ? py * width + px : 0;
    const Footprint& footprint = inside ? footprints[g.pixel[lane]] : none;
    g.lanes |= uint32_t(footprint.valid) << lane;
    for (int axis = 0; axis < 3; ++axis) {
      g.position[axis][lane] = footprint.position[axis];
      g.ray_origin[axis][lane] = footprint.ray_origin[axis];
      g.normal[axis][lane] = footprint.valid ? footprint.brdf.normal()[axis] : 0;
      g.geometric_normal[axis][lane] = footprint.valid ? footprint.brdf.geometric_normal()[axis] : 0;
    }
  }
  return g;
}

uint32_t aim(const ReceiverGroup& g, const GroupTarget& t, SegmentPacket* packet) {
  const glm::vec3 n = t.normal, q = t.geometric_normal;
  for (uint32_t i = 0; i < ReceiverGroup::width; ++i) {
    const float x = t.position.x - g.position[0][i];
    const float y = t.position.y - g.position[1][i];
    const float z = t.position.z - g.position[2][i];
    const float normal2 = g.normal[0][i] * x + g.normal[1][i] * y + g.normal[2][i] * z;
    const float geometric2 =
        g.geometric_normal[0][i] * x + g.geometric_normal[1][i] * y + g.geometric_normal[2][i] * z;
    const float normal1 = -(n.x * x + n.y * y + n.z * z);
    const float geometric1 = -(q.x * x + q.y * y + q.z * z);
    packet->origin[0][i] = g.ray_origin[0][i];
    packet->origin[1][i] = g.ray_origin[1][i];
    packet->origin[2][i] = g.ray_origin[2][i];
    packet->direction[0][i] = t.ray_origin.x - g.ray_origin[0][i];
    packet->direction[1][i] = t.ray_origin.y - g.ray_origin[1][i];
    packet->direction[2][i] = t.ray_origin.z - g.ray_origin[2][i];
    const bool faces = (normal2 > 0) & (geometric2 > 0) & (normal1 > 0) & (geometric1 > 0);
    packet->end[i] = faces ? 1.0f : -1.0f;
  }
  uint32_t on = 0;
  for (uint32_t i = 0; i < ReceiverGroup::width; ++i) on |= uint32_t(packet->end[i] >= 0) << i;
  return on;
}

}  // namespace vsglbench
