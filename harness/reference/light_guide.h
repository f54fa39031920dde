// Where on the light's plane the x1 lie that light a tile of pixels: learned, then sampled from. Any such
// density keeps the estimate unbiased, since a quarter of it is uniform; a good one spares the rays to x1
// that face away or hide (in the manner of Jensen 1995, "Importance Driven Path Tracing Using the Photon
// Map").
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace vsglbench {

class LightGuide {
 public:
  static constexpr uint32_t cell_bits = 5, cells = 1u << cell_bits;  // cells x cells over the light's plane
  using Table = std::array<float, cells * cells>;

  // Square tiles of 8 pixels in an image of 480x272, and of about as many of them in a larger one. Uniform
  // everywhere until learn().
  LightGuide(uint32_t width, uint32_t height);

  uint32_t tile_size() const { return tile_size_; }
  uint32_t tiles_x() const { return tiles_x_; }
  uint32_t tiles() const { return static_cast<uint32_t>(tiles_.size()); }
  uint32_t tile(uint32_t x, uint32_t y) const { return y / tile_size_ * tiles_x_ + x / tile_size_; }

  // Adds to what a cell has contributed to a tile. Different tiles may be taught at the same time.
  void teach(uint32_t tile, uint32_t cell, float contribution) { tiles_[tile].learned[cell] += contribution; }
  // Adds all that another guide of the same tiles was taught, and makes every tile's density anew.
  void learn_from(const LightGuide& other);
  // Makes a tile's density from all it was taught and its neighbours were. Tiles may learn at the same time.
  void learn(uint32_t tile);

  // The cell that 32 uniform bits choose, with probability density/cells^2, in the cells' order.
  uint32_t sample(uint32_t tile, uint32_t bits) const {
    return tiles_[tile].choices[bits >> (32 - choice_bits)];
  }
  // Mean 1 over the cells.
  float density(uint32_t tile, uint32_t cell) const {
    return tiles_[tile].counts[cell] * (1.0f / (1u << (choice_bits - 2 * cell_bits)));
  }
  // Cells are counted in Morton's order, so that stratified bits choose cells stratified over the plane.
  static uint32_t cell(const glm::uvec2& column_row) {
    return spread(column_row.x) | spread(column_row.y) << 1;
  }
  static uint32_t cell(const glm::vec2& uv) {
    return cell(glm::min(glm::uvec2(uv * float(cells)), glm::uvec2(cells - 1)));
  }
  static glm::uvec2 column_row(uint32_t cell) { return {gather(cell), gather(cell >> 1)}; }

 private:
  // A tile's density in whole numbers: each cell stands once, and more often by its merit, in a list to draw
  // from.
  static constexpr uint32_t choice_bits = 2 * cell_bits + 2;
  struct Tile {
    Table learned{};
    std::array<uint16_t, cells * cells> counts;
    std::array<uint16_t, 1u << choice_bits> choices;
  };
  static void build(const Table& weights, Tile* tile);

  // Bits 0, 1, 2 ... to bits 0, 2, 4 ..., and back; eight of them.
  static uint32_t spread(uint32_t i) {
    i = (i | i << 4) & 0x0f0fu;
    i = (i | i << 2) & 0x3333u;
    return (i | i << 1) & 0x5555u;
  }
  static uint32_t gather(uint32_t i) {
    i &= 0x5555u;
    i = (i | i >> 1) & 0x3333u;
    i = (i | i >> 2) & 0x0f0fu;
    return (i | i >> 4) & 0x00ffu;
  }

  uint32_t tile_size_, tiles_x_, tiles_y_;
  std::vector<Tile> tiles_;
};

}  // namespace vsglbench
