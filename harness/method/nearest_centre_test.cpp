// Both searches against a brute force in the same single precision, and against FLANN.
#include "base/error.h"
#include "method/nearest_fixture.h"

using namespace vsglbench;

namespace {

// Both searches against the brute force, in both dimensions (`centres(d)` for d of them).
template <class Centres>
void expect_exact(glm::uvec2 size, const Points& positions, const Centres& centres, const std::string& what) {
  NearestBench bench(size, positions);
  for (const int dimensions : {2, 3}) {
    const Points c = centres(dimensions);
    const Ids expected = brute_force(positions, size, c, dimensions);
    for (const Search search : {Search::kd_tree, Search::tiles}) {
      EXPECT_EQ(differences(bench.ids(c, dimensions, search), expected), 0u)
          << what << ", " << c.size() << " centres, " << dimensions << "-D, "
          << (search == Search::tiles ? "tiles" : "kd-tree");
    }
  }
}

void expect_as_flann(glm::uvec2 size, const Points& positions, const Points& centres, int dimensions) {
  NearestBench bench(size, positions);
  const Ids tiles = bench.ids(centres, dimensions, Search::tiles);
  EXPECT_EQ(differences(tiles, bench.ids(centres, dimensions, Search::kd_tree)), 0u);
  const auto expected = flann_distances(positions, size, centres, dimensions);
  size_t wrong = 0;
  for (size_t i = 0; i < tiles.size(); ++i) {
    if (!(positions[i].w > 0)) {
      wrong += tiles[i] != centres.size();
    } else {
      wrong += tiles[i] >= centres.size() || squared(query_of(positions, size, dimensions, i),
                                                     centres[tiles[i]], dimensions) != expected[i];
    }
  }
  EXPECT_EQ(wrong, 0u) << centres.size() << " centres, " << dimensions << "-D";
}

}  // namespace

TEST(NearestCentre, IsExactAtEverySize) {
  for (const glm::uvec2 size :
       {glm::uvec2(1, 1), glm::uvec2(2, 1), glm::uvec2(255, 1), glm::uvec2(16, 16), glm::uvec2(257, 1),
        glm::uvec2(7, 5), glm::uvec2(1, 4096), glm::uvec2(97, 61)}) {
    const Points positions = posts(size);
    for (const size_t count : {1, 2, 3, 8, 9, 255, 256, 257}) {
      expect_exact(
          size, positions, [&](int d) { return random_centres(positions, size, d, count); },
          fmt::format("{}x{}", size.x, size.y));
    }
  }
}

TEST(NearestCentre, IsExactWithAsManyCentresAsTexels) {
  const glm::uvec2 size(96, 64);
  const Points positions = posts(size);
  expect_exact(
      size, positions, [&](int d) { return random_centres(positions, size, d, positions.size()); }, "random");
  // Every texel its own centre.
  const auto own = [&](int d) {
    Points c;
    for (size_t i = 0; i < positions.size(); ++i)
      c.emplace_back(query_of(positions, size, d, i), positions[i].w);
    return c;
  };
  expect_exact(size, positions, own, "own");
}

TEST(NearestCentre, OfCoincidentCentresTheFirstWins) {
  const glm::uvec2 size(64, 48);
  const Points positions = posts(size, 0);
  for (const size_t count : {2, 300, 2048}) {
    const Points equal(count, positions[1000]);
    expect_exact(
        size, positions, [&](int) { return equal; }, "all equal");
    const auto twice = [&](int d) {
      Points c = random_centres(positions, size, d, count / 2 + 1);
      const Points copy(c.rbegin(), c.rend());
      c.insert(c.end(), copy.begin(), copy.end());
      return c;
    };
    expect_exact(size, positions, twice, "each twice");
  }
}

TEST(NearestCentre, CollinearCentresAreExact) {
  const glm::uvec2 size(65, 33);
  const Points positions = posts(size);
  for (const glm::vec3 step : {glm::vec3(0.25f, 0, 0), glm::vec3(0, 0.25f, 0), glm::vec3(0.125f)}) {
    Points line;
    for (int i = 0; i < 300; ++i) line.emplace_back(step * float(i * 77 % 300), 1);
    expect_exact(
        size, positions, [&](int) { return line; }, "line");
  }
}

// Centres on a circle about a texel are all equally near, to the last bit or nearly.
TEST(NearestCentre, EquidistantCentresAreExact) {
  const glm::uvec2 size(33, 33);
  const Points positions = posts(size);
  Points ring;
  for (const int sign : {-1, 1}) {
    for (const auto& [a, b] : {std::pair{3, 4}, {4, 3}, {0, 5}, {5, 0}, {-3, 4}, {-4, 3}})
      ring.emplace_back(16.5f + sign * a, 16.5f + sign * b, 0, 1);
  }
  for (int i = 0; i < 500; ++i)
    ring.emplace_back(16.5f + 9 * std::cos(0.1f * i), 16.5f + 9 * std::sin(0.1f * i), 0, 1);
  expect_exact(
      size, positions, [&](int) { return ring; }, "ring");
}

TEST(NearestCentre, CentresOutsideTheQueriesAreExact) {
  const glm::uvec2 size(61, 35);
  const Points positions = posts(size);
  std::mt19937 random(2);
  Points far;
  for (int i = 0; i < 400; ++i) {
    const glm::vec3 direction(random_unit(random) - 0.5f, random_unit(random) - 0.5f,
                              random_unit(random) - 0.5f);
    far.emplace_back(300.0f * glm::normalize(direction), 1);
  }
  expect_exact(
      size, positions, [&](int) { return far; }, "far centres");
  far.emplace_back(1e15f, -1e15f, 1e15f, 1);  // one that squeezes the others into one Morton cell
  expect_exact(
      size, positions, [&](int) { return far; }, "an outlier");
}

TEST(NearestCentre, IsExactFarFromTheOrigin) {
  const glm::uvec2 size(96, 64);
  for (const float offset : {1e3f, 1e6f}) {
    const Points positions = posts(size, 0.05f, glm::vec3(offset, -offset, offset));
    expect_exact(
        size, positions, [&](int d) { return random_centres(positions, size, d, 500); }, "far origin");
  }
}

TEST(NearestCentre, WhatIsNoCentreIsNeverChosen) {
  const glm::uvec2 size(40, 30);
  const Points positions = posts(size, 0.3f);
  const auto some = [&](int d) {
    Points c = random_centres(positions, size, d, 300);
    for (size_t i = 0; i < c.size(); i += 3) c[i].w = 0;
    return c;
  };
  expect_exact(size, positions, some, "a third is none");
  const auto none = [&](int d) {
    Points c = random_centres(positions, size, d, 300);
    for (auto& centre : c) centre.w = 0;
    return c;
  };
  expect_exact(size, positions, none, "none at all");
  const Points empty(positions.size(), glm::vec4(0));
  expect_exact(
      size, empty, [&](int) { return random_centres(positions, size, 3, 20); }, "no surface");
}

// The importance lights of the G-buffer and the lights of the RSM are of one frame.
TEST(NearestCentre, ALargerSearchLeavesAnEarlierOneOfTheSameFrameAlone) {
  const glm::uvec2 size(61, 35);
  const Points positions = posts(size);
  const Points few = random_centres(positions, size, 3, 100), many = random_centres(positions, size, 3, 1500);
  for (const Search search : {Search::kd_tree, Search::tiles}) {
    NearestBench bench(size, positions);
    const auto [first, second] = bench.in_one_frame(few, many, 3, search);
    EXPECT_EQ(differences(first, brute_force(positions, size, few, 3)), 0u);
    EXPECT_EQ(differences(second, brute_force(positions, size, many, 3)), 0u);
  }
}

TEST(NearestCentre, RefusesNoCentresAndTooMany) {
  const glm::uvec2 size(4, 4);
  NearestBench bench(size, posts(size));
  EXPECT_THROW(bench.ids({}, 2, Search::tiles), Error);
}

class NearestCentreFlann : public ::testing::TestWithParam<std::tuple<glm::uvec2, size_t, bool>> {};

TEST_P(NearestCentreFlann, EveryDistanceIsTheLeast) {
  const auto [size, count, concentrated] = GetParam();
  const Points positions = posts(size);
  for (const int dimensions : {2, 3}) {
    expect_as_flann(size, positions, random_centres(positions, size, dimensions, count, concentrated),
                    dimensions);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, NearestCentreFlann,
                         ::testing::Values(std::tuple{glm::uvec2(512, 512), 1024, false},
                                           std::tuple{glm::uvec2(512, 512), 1024, true},
                                           std::tuple{glm::uvec2(512, 512), 65536, true},
                                           std::tuple{glm::uvec2(512, 512), 262144, false},
                                           std::tuple{glm::uvec2(1920, 1088), 2048, false},
                                           std::tuple{glm::uvec2(1920, 1088), 2048, true}));

// The texels that the host's own double-precision warp chooses; all but those whose comparisons round apart.
TEST(CentreSampler, ChoosesTheTexelsThatTheWarpDoes) {
  const auto half = random_half(61, 35, 9);
  const glm::uvec2 size(half.emitter.width, half.emitter.height);
  Points positions;
  for (const auto& t : half.texels) positions.emplace_back(t.position, t.surface ? 1 : 0);
  NearestBench bench(size, positions);
  const oracle::Pyramid pyramid(half);
  const uint32_t count = 500;
  for (const int dimensions : {2, 3}) {
    const auto [centres, ids] = bench.sampled(pdf_pyramid(half), count, dimensions, Search::tiles);
    uint32_t apart = 0;
    for (uint32_t i = 0; i < count; ++i) {
      const auto fixed = lattice_point(i, count, NearestBench::kShift);
      const glm::uvec2 t = pyramid.warp(unit_interval(fixed).x, unit_interval(fixed).y);
      const glm::vec4 expected(query_of(positions, size, dimensions, t.y * size.x + t.x), 1);
      apart += centres[i] != expected;
    }
    EXPECT_LE(apart, count / 100) << dimensions << "-D";
    EXPECT_EQ(differences(ids, brute_force(positions, size, centres, dimensions)), 0u);
  }
}

TEST(CentreSampler, APdfThatIsZeroEverywhereGivesNoCluster) {
  const glm::uvec2 size(64, 36);
  NearestBench bench(size, posts(size, 0));
  const std::vector<float> zero(pyramid_texels(size.x, size.y), 0.0f);
  for (const int dimensions : {2, 3}) {
    for (const Search search : {Search::kd_tree, Search::tiles}) {
      const auto [centres, ids] = bench.sampled(zero, 100, dimensions, search);
      EXPECT_EQ(differences(ids, Ids(size.x * size.y, 100)), 0u);
      for (const auto& c : centres) EXPECT_EQ(c.w, 0);
    }
  }
}

TEST(CentreSampler, APdfOfOneTexelGivesOneCluster) {
  auto half = random_half(32, 32, 4);
  std::fill(half.pdf.begin(), half.pdf.end(), 0.0f);
  half.pdf[32 * 20 + 7] = 3;
  half.texels[32 * 20 + 7].surface = true;
  Points positions;
  for (const auto& t : half.texels) positions.emplace_back(t.position, 1);
  NearestBench bench({32, 32}, positions);
  for (const int dimensions : {2, 3}) {
    const auto [centres, ids] = bench.sampled(pdf_pyramid(half), 1024, dimensions, Search::tiles);
    EXPECT_EQ(centres[1023], centres[0]);
    EXPECT_EQ(differences(ids, Ids(32 * 32, 0)), 0u);
  }
}

TEST(NearestCentre, IsSilentUnderValidation) {
  Device checked({.validation = true});
  const glm::uvec2 size(61, 35);
  const Points positions = posts(size);
  std::vector<float> pdf(pyramid_texels(size.x, size.y), 1.0f);
  {
    KernelLibrary kernels(checked);
    NearestBench bench(size, positions, kernels);
    for (const int dimensions : {2, 3}) {
      for (const Search search : {Search::kd_tree, Search::tiles})
        bench.sampled(pdf, 256, dimensions, search);
    }
  }
  for (const auto& message : checked.validation_messages()) ADD_FAILURE() << message;
}

TEST(NearestCentre, TheSearchsBlocksAreChosenByDevice) {
  DeviceInfo info;
  info.type = "cpu";
  EXPECT_EQ(choose_search_block(Search::tiles, info), glm::uvec2(8, 4));
  EXPECT_EQ(choose_search_block(Search::kd_tree, info), glm::uvec2(1, 1));
  info.type = "discrete";
  EXPECT_EQ(choose_search_block(Search::tiles, info), glm::uvec2(1, 1));
  EXPECT_EQ(choose_search_block(Search::kd_tree, info), glm::uvec2(1, 1));
}
