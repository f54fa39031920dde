#include "reference/light_guide.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vsglbench {
namespace {

constexpr int kCells = LightGuide::cells;

float sum_of(const LightGuide::Table& table) { return std::accumulate(table.begin(), table.end(), 0.0f); }

// 3x3 tent; what one cell sends, its neighbours likely do.
LightGuide::Table blurred(const LightGuide::Table& table) {
  LightGuide::Table result{};
  for (uint32_t i = 0; i < table.size(); ++i) {
    if (table[i] == 0) continue;
    const glm::ivec2 at(LightGuide::column_row(i));
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const glm::ivec2 to = at + glm::ivec2(dx, dy);
        if (to.x < 0 || to.x >= kCells || to.y < 0 || to.y >= kCells) continue;
        result[LightGuide::cell(glm::uvec2(to))] +=
            table[i] * float((2 - std::abs(dx)) * (2 - std::abs(dy))) / 16;
      }
    }
  }
  return result;
}

uint32_t size_of_tile(uint32_t width, uint32_t height) {
  const double scale = std::sqrt(double(width) * height / (480.0 * 272.0));
  return 8 * static_cast<uint32_t>(std::max(1.0, std::round(scale)));
}

}  // namespace

LightGuide::LightGuide(uint32_t width, uint32_t height)
    : tile_size_(size_of_tile(width, height)),
      tiles_x_((width + tile_size_ - 1) / tile_size_),
      tiles_y_((height + tile_size_ - 1) / tile_size_),
      tiles_(size_t(tiles_x_) * tiles_y_) {
  Table uniform;
  uniform.fill(1);
  for (Tile& tile : tiles_) build(uniform, &tile);
}

// `weights` of any positive sum: three quarters of the choices go by them, rounded so that the sums up to
// each cell stay exact to one.
void LightGuide::build(const Table& weights, Tile* tile) {
  constexpr uint32_t merited = (1u << choice_bits) - cells * cells;
  const double scale = merited / double(sum_of(weights));
  double sum = 0;
  uint32_t given = 0, next = 0;
  for (uint32_t cell = 0; cell < weights.size(); ++cell) {
    sum += weights[cell] * scale;
    const bool last = cell + 1 == weights.size();
    const uint32_t upto = last ? merited : std::clamp(static_cast<uint32_t>(sum + 0.5), given, merited);
    tile->counts[cell] = static_cast<uint16_t>(1 + upto - given);
    given = upto;
    std::fill_n(tile->choices.begin() + next, tile->counts[cell], static_cast<uint16_t>(cell));
    next += tile->counts[cell];
  }
}

void LightGuide::learn_from(const LightGuide& other) {
  for (size_t tile = 0; tile < tiles_.size(); ++tile)
    for (size_t cell = 0; cell < tiles_[tile].learned.size(); ++cell)
      tiles_[tile].learned[cell] += other.tiles_.at(tile).learned[cell];
  for (uint32_t tile = 0; tile < tiles(); ++tile) learn(tile);
}

void LightGuide::learn(uint32_t tile) {
  // The tile's own, and a quarter of its neighbours'.
  Table weights{};
  const int x = int(tile % tiles_x_), y = int(tile / tiles_x_);
  for (int i = 0; i < 9; ++i) {
    const int nx = x + i % 3 - 1, ny = y + i / 3 - 1;
    if (nx < 0 || ny < 0 || nx >= int(tiles_x_) || ny >= int(tiles_y_)) continue;
    const Table& learned = tiles_[size_t(ny) * tiles_x_ + nx].learned;
    for (size_t c = 0; c < learned.size(); ++c) weights[c] += learned[c] * (i == 4 ? 1.0f : 0.25f);
  }

  weights = blurred(weights);
  if (sum_of(weights) > 0) build(weights, &tiles_[tile]);
}

}  // namespace vsglbench
