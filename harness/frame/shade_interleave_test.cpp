// Lights that the pixels of a block share out, and the filter that joins the shares, from their definitions.
#include "frame/shade_fixture.h"

using namespace vsglbench;

namespace {

class InterleaveTest : public ShadeTest {
 protected:
  // Two walls that face the camera, the right one a metre behind, with a texture of stripes.
  InterleaveTest() {
    for (uint32_t y = 0; y < kHeight; ++y) {
      for (uint32_t x = 0; x < kWidth; ++x) {
        const float z = is_right(x) ? -1.0f : 0.0f, stripe = x % 3 == 0 ? 0.9f : 0.1f;
        const glm::vec2 plane(2 * (x + 0.5f) / kWidth - 1, 1 - 2 * (y + 0.5f) / kHeight);
        walls_[0].emplace_back(glm::vec3(plane * (3 - z), z), 1);
        walls_[1].emplace_back(0, 0, 1, 0.5f);
        walls_[2].emplace_back(0, 0, 1, 0);
        walls_[3].emplace_back(stripe, 0.5f * stripe, 0.3f, 0);
        walls_[4].emplace_back(0.04f, 0.04f, 0.04f, 0);
      }
    }
    for (size_t i = 0; i < 5; ++i) {
      wall_images_.emplace_back(device(), "map", VK_FORMAT_R32G32B32A32_SFLOAT, kWidth, kHeight,
                                VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
      wall_images_.back().upload(walls_[i].data(), walls_[i].size() * sizeof(glm::vec4));
    }
  }

  static bool is_right(uint32_t x) { return x > kWidth / 2; }
  glm::vec3 reflectance(size_t pixel) const {
    return glm::vec3(walls_[3][pixel]) + glm::vec3(walls_[4][pixel]);
  }

  std::vector<glm::vec4> join(const std::vector<glm::vec4>& shares, uint32_t block) {
    const ShaderDefines defines = {{"INTERLEAVE", fmt::format("{}u", block)}};
    const Kernel& kernel = kernels().get(data_root() / "harness" / "frame" / "join.comp", defines);
    const Buffer in = upload(shares), out(device(), "out", shares.size() * sizeof(glm::vec4));
    const FieldMaps maps{&wall_images_[0], &wall_images_[1], &wall_images_[2], &wall_images_[3],
                         &wall_images_[4]};
    Recorder recorder(device());
    recorder.begin();
    recorder.pass({.step = "join"}, [&] {
      recorder.dispatch(kernel, {maps, in, out}, camera_, groups_for(kWidth, 8), groups_for(kHeight, 8));
    });
    recorder.submit_and_wait();
    return out.download<glm::vec4>(shares.size());
  }

  std::array<std::vector<glm::vec4>, 5> walls_;
  std::vector<DeviceImage> wall_images_;
};

// Pixel (x, y) of a block of k by k has every k²-th light from its own on, each k² times.
TEST_F(InterleaveTest, APixelHasItsOwnLights) {
  std::vector<gpu::Vsgl> lights;
  for (uint32_t i = 0; i < kLights; ++i) lights.push_back(random_vsgl());
  for (const uint32_t block : {2u, 4u, 8u}) {
    const auto shares = shade(lights, {}, {}, {}, block);
    for (uint32_t set = 0; set < block * block; ++set) {
      std::vector<gpu::Vsgl> own;
      for (uint32_t i = set; i < kLights; i += block * block) own.push_back(lights[i]);
      std::vector<glm::vec4> expected(shares.size(), glm::vec4(0));
      if (!own.empty()) expected = shade(own);
      for (uint32_t y = set / block; y < kHeight; y += block) {
        for (uint32_t x = set % block; x < kWidth; x += block) {
          const size_t pixel = y * kWidth + x;
          const glm::vec3 want = static_cast<float>(block * block) * glm::vec3(expected[pixel]);
          EXPECT_LE(glm::distance(glm::vec3(shares[pixel]), want), 1e-5f * glm::length(want))
              << block << ": " << x << ", " << y;
        }
      }
    }
  }
}

// Lights in two dispatches are the same lights.
TEST_F(InterleaveTest, RangesOfLightsAddUp) {
  std::vector<gpu::Vsgl> lights;
  for (uint32_t i = 0; i < kLights; ++i) lights.push_back(random_vsgl());
  const auto whole = shade(lights, {}, {}, {}, 2);
  const auto low = shade(lights, {}, {.first = 0, .count = 23}, {}, 2),
             high = shade(lights, {}, {.first = 23, .count = kLights - 23}, {}, 2);
  for (size_t i = 0; i < whole.size(); ++i) {
    const glm::vec3 sum = glm::vec3(low[i]) + glm::vec3(high[i]);
    EXPECT_LE(glm::distance(glm::vec3(whole[i]), sum), 1e-5f * glm::length(sum)) << i;
  }
}

// Under one irradiance a wall, its pixels' shares make it up whatever part each has; none of it comes from
// the other wall, and the texture stays as it is.
TEST_F(InterleaveTest, JoinedSharesAreTheWhole) {
  for (const uint32_t block : {2u, 4u, 8u}) {
    std::vector<float> part;
    float all = 0;
    for (uint32_t set = 0; set < block * block; ++set) all += part.emplace_back(uniform());
    std::vector<glm::vec4> shares;
    const auto irradiance = [](uint32_t x) {
      return is_right(x) ? glm::vec3(0.25f, 0, 3) : glm::vec3(1, 2, 0);
    };
    for (uint32_t y = 0; y < kHeight; ++y) {
      for (uint32_t x = 0; x < kWidth; ++x) {
        const float weight = part[y % block * block + x % block] / all * static_cast<float>(block * block);
        shares.emplace_back(weight * irradiance(x) * reflectance(y * kWidth + x), weight);
      }
    }
    const auto joined = join(shares, block);
    const uint32_t edge = kWidth / 2;  // the last column of the left wall
    for (uint32_t y = 0; y < kHeight; ++y) {
      for (uint32_t x = 0; x < kWidth; ++x) {
        const glm::vec3 got = glm::vec3(joined[y * kWidth + x]),
                        want = irradiance(x) * reflectance(y * kWidth + x);
        const std::string where = fmt::format("{}: {}, {}", block, x, y);
        if (x + block <= edge || x >= edge + block) {
          EXPECT_LE(glm::distance(got, want), 1e-5f * glm::length(want)) << where;
          EXPECT_NEAR(joined[y * kWidth + x].a, 1, 1e-5) << where;
        } else {
          // At the edge some shares are missing, but no colour is another wall's.
          EXPECT_EQ(got[is_right(x) ? 1 : 2], 0) << where;
          EXPECT_GT(got[0], 0) << where;
        }
      }
    }
  }
}

// A pixel without a surface stays black, and gives nothing to its neighbours.
TEST_F(InterleaveTest, NoSurfaceIsBlack) {
  const uint32_t hole = 5 * kWidth + 7;
  walls_[0][hole].w = 0;
  wall_images_[0].upload(walls_[0].data(), walls_[0].size() * sizeof(glm::vec4));
  std::vector<glm::vec4> shares;
  for (size_t i = 0; i < walls_[0].size(); ++i) shares.emplace_back(reflectance(i), 0);
  shares[hole] = glm::vec4(1e6f);
  const auto joined = join(shares, 4);
  EXPECT_EQ(joined[hole], glm::vec4(0));
  for (size_t i = 0; i < shares.size(); ++i) {
    if (i == hole) continue;
    EXPECT_LE(glm::distance(glm::vec3(joined[i]), reflectance(i)), 1e-5f) << i;
  }
}

}  // namespace
