#include "reference/visibility.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/parallel.h"

namespace vsglbench {
namespace {

constexpr uint32_t kTile = 4;       // a packet is 4x4 neighbouring pixels towards one light
constexpr uint32_t kBandRows = 32;  // rows of a work item: a whole number of words at every width

// 16 pixels, ready to be aimed at any target. A lane without a surface has a zero normal.
struct alignas(64) Tile {
  float origin[3][SegmentPacket::width];  // moved off the surface
  float normal[3][SegmentPacket::width];
  float distance_along[SegmentPacket::width];  // dot(normal, position)
  uint32_t pixel[4];                           // of the first column of each row
  uint32_t rows = 0, columns = 0;
};

struct Band {
  size_t first_tile, last_tile;
};

Tile make_tile(const Tracer& tracer, std::span<const ReceiverPoint> receivers, uint32_t width,
               uint32_t height, uint32_t x, uint32_t y) {
  Tile tile;
  tile.rows = std::min(kTile, height - y);
  tile.columns = std::min(kTile, width - x);
  for (uint32_t row = 0; row < kTile; ++row) tile.pixel[row] = (y + row) * width + x;
  for (uint32_t lane = 0; lane < SegmentPacket::width; ++lane) {
    const uint32_t row = lane / kTile, column = lane % kTile;
    ReceiverPoint point;
    if (row < tile.rows && column < tile.columns) point = receivers[tile.pixel[row] + column];
    const glm::vec3 normal = point.valid ? point.geometric_normal : glm::vec3(0);
    const glm::vec3 origin = tracer.offset(point.position, normal);
    for (int axis = 0; axis < 3; ++axis) {
      tile.origin[axis][lane] = origin[axis];
      tile.normal[axis][lane] = normal[axis];
    }
    tile.distance_along[lane] = glm::dot(normal, point.position);
  }
  return tile;
}

// Tiles in bands of kBandRows rows.
std::vector<Tile> make_tiles(const Tracer& tracer, std::span<const ReceiverPoint> receivers, uint32_t width,
                             uint32_t height, std::vector<Band>* bands) {
  std::vector<Tile> tiles;
  for (uint32_t band = 0; band < height; band += kBandRows) {
    const size_t first = tiles.size();
    for (uint32_t y = band; y < std::min(band + kBandRows, height); y += kTile) {
      for (uint32_t x = 0; x < width; x += kTile)
        tiles.push_back(make_tile(tracer, receivers, width, height, x, y));
    }
    bands->push_back({first, tiles.size()});
  }
  return tiles;
}

// Segments from the tile's pixels to the target, ended before it. Returns the lanes in front of which it
// lies; of these, those inside the cluster's own radius need no ray: their lane is off.
uint32_t aim(const Tile& tile, const TargetPoint& target, float stop, SegmentPacket* packet) {
  uint32_t facing = 0;
  const glm::vec3 t = target.position;
  for (int i = 0; i < SegmentPacket::width; ++i) {
    const float x = t.x - tile.origin[0][i], y = t.y - tile.origin[1][i], z = t.z - tile.origin[2][i];
    const float side = tile.normal[0][i] * t.x + tile.normal[1][i] * t.y + tile.normal[2][i] * t.z;
    const float length = std::sqrt(x * x + y * y + z * z);
    packet->origin[0][i] = tile.origin[0][i];
    packet->origin[1][i] = tile.origin[1][i];
    packet->origin[2][i] = tile.origin[2][i];
    packet->direction[0][i] = x;
    packet->direction[1][i] = y;
    packet->direction[2][i] = z;
    const bool in_front = side > tile.distance_along[i];
    packet->end[i] = in_front && length > stop ? 1 - stop / length : -1;
    facing |= uint32_t(in_front) << i;
  }
  return facing;
}

uint64_t active_lanes(const SegmentPacket& packet) {
  uint64_t n = 0;
  for (const float end : packet.end) n += end >= 0;
  return n;
}

// Bits of one light over one band. Returns the rays traced.
uint64_t trace_band(const Tracer& tracer, std::span<const Tile> tiles, const TargetPoint& target,
                    uint32_t* words) {
  const float stop = target.stop_short + tracer.epsilon(target.position);
  uint64_t rays = 0;
  for (const Tile& tile : tiles) {
    SegmentPacket packet;
    uint32_t visible = aim(tile, target, stop, &packet);
    if (visible == 0) continue;
    rays += active_lanes(packet);
    visible &= ~tracer.occluded(packet);
    for (uint32_t row = 0; row < tile.rows; ++row) {
      for (uint32_t column = 0; column < tile.columns; ++column) {
        const uint32_t pixel = tile.pixel[row] + column;
        words[pixel / 32] |= (visible >> (row * kTile + column) & 1u) << (pixel % 32);
      }
    }
  }
  return rays;
}

}  // namespace

VisibilityBits compute_visibility(const Tracer& tracer, std::span<const ReceiverPoint> receivers,
                                  uint32_t width, uint32_t height, std::span<const TargetPoint> targets,
                                  unsigned threads) {
  const auto start = std::chrono::steady_clock::now();
  VisibilityBits bits;
  bits.pixels = width * height;
  bits.lights = static_cast<uint32_t>(targets.size());
  bits.words_per_light = (bits.pixels + 31) / 32;
  bits.words.assign(size_t(bits.lights) * bits.words_per_light, 0);

  std::vector<Band> bands;
  const std::vector<Tile> tiles = make_tiles(tracer, receivers, width, height, &bands);
  std::vector<uint64_t> rays(thread_count(threads), 0);
  parallel_for(uint64_t(bits.lights) * bands.size(), threads, [&](uint64_t i, unsigned thread) {
    const size_t light = i / bands.size();
    const Band& band = bands[i % bands.size()];
    const std::span<const Tile> some(tiles.data() + band.first_tile, band.last_tile - band.first_tile);
    rays[thread] += trace_band(tracer, some, targets[light], &bits.words[light * bits.words_per_light]);
  });
  for (const uint64_t n : rays) bits.rays += n;
  bits.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return bits;
}

}  // namespace vsglbench
