#include "method/oracle.h"

#include <gtest/gtest.h>

#include "method/lattice.h"
#include "method/made_half.h"

namespace vsglbench {
namespace {

// Whatever the size, every base texel counts as often as every other: the mean over all positions of what is
// filtered is the mean over the texels, on each level.
TEST(Oracle, FilteringOnALevelKeepsTheSumOverTexels) {
  for (const glm::uvec2 size : {glm::uvec2(64, 64), glm::uvec2(61, 35), glm::uvec2(7, 5), glm::uvec2(33, 17),
                                glm::uvec2(9, 1), glm::uvec2(1, 66), glm::uvec2(120, 68)}) {
    const oracle::Half half = random_half(size.x, size.y, 3);
    const oracle::Pyramid pyramid(half);
    oracle::Sums texels;
    for (uint32_t i = 0; i < half.texels.size(); ++i)
      texels.add(oracle::texel_sums(half, i % size.x, i / size.x), 1);
    for (uint32_t level = 0; level <= pyramid.top(); ++level) {
      double p = 0;
      oracle::Sums filtered;
      for (uint32_t i = 0; i < half.texels.size(); ++i) {
        const double x = i % size.x + 0.5, y = i / size.x + 0.5;
        p += pyramid.pdf(x, y, level) / static_cast<double>(half.texels.size());
        filtered.add(pyramid.sums(x, y, level), 1);
      }
      EXPECT_NEAR(p, 1, 1e-9) << size.x << "x" << size.y << " level " << level;
      EXPECT_NEAR(filtered.diffuse.y / texels.diffuse.y, 1, 1e-9)
          << size.x << "x" << size.y << " level " << level;
    }
  }
}

// By hand: 2^32 (1/5, 1/φ) and the middle of a 2^-23 interval.
TEST(Lattice, PointsAndTheirPlaceInTheUnitSquare) {
  EXPECT_EQ(lattice_point(1, 5, {0, 0}), glm::uvec2(858993459u, 2654435769u));
  EXPECT_EQ(lattice_point(3, 5, {1000000000u, 7u}), glm::uvec2(3576980377u, 3668340011u + 7u));
  EXPECT_EQ(unit_interval({0, 0xffffffffu}), glm::dvec2(0x1p-24, 1 - 0x1p-24));
}

}  // namespace
}  // namespace vsglbench
