#include "measure/block_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace vsglbench {
namespace {

TEST(BlockMap, FitsTheExponentOfAPowerLaw) {
  EXPECT_NEAR(growth_exponent({{1, 3}, {10, 30}, {100, 300}}), 1, 1e-12);
  EXPECT_NEAR(growth_exponent({{4, 5 * std::sqrt(4.0)}, {64, 5 * 8}}), 0.5, 1e-12);
}

TEST(BlockMap, SizesOfImages) {
  EXPECT_EQ(image_size(2088960), std::pair(1920u, 1088u));
  EXPECT_EQ(image_size(262144), std::pair(512u, 512u));
  for (const uint64_t n : {1, 2, 7, 12, 257}) {
    const auto [w, h] = image_size(n);
    EXPECT_EQ(uint64_t{w} * h, n);
  }
}

// Every block at a small size: right results, and a row for each contestant.
TEST(BlockMap, EveryBlockIsRightBeforeItIsTimed) {
  Device device;
  for (const auto& name : block_names()) {
    const auto block = make_block(device, name);
    const BlockMap map = measure_block(*block, {4096, 12000}, 2);
    EXPECT_FALSE(map.times.empty());
    bool host = false, on_device = false;
    for (const BlockTime& t : map.times) {
      EXPECT_EQ(t.ms.samples.size(), 2u);
      EXPECT_GT(t.ms.median, 0) << name << " " << t.contestant;
      (t.on_device ? on_device : host) = true;
    }
    EXPECT_TRUE(host && on_device) << name;
    EXPECT_FALSE(map.growth.empty()) << name;
    for (const auto& input : block->inputs()) EXPECT_NE(block_table(map).find(input), std::string::npos);
  }
}

// A contestant whose result is wrong is named and not timed.
TEST(BlockMap, AWrongResultIsAnError) {
  struct Wrong : Block {
    int runs = 0;
    std::string name() const override { return "wrong"; }
    std::string counted() const override { return "items"; }
    std::vector<std::string> inputs() const override { return {"input"}; }
    std::vector<uint64_t> sizes() const override { return {1}; }
    std::vector<Contestant> prepare(const std::string&, uint64_t) override {
      return {{"liar", true, [this] { return ++runs, 1.0; }, [] { return "2 instead of 1"; }}};
    }
  } wrong;
  try {
    measure_block(wrong, {1}, 5);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()), "wrong, input, 1 items: liar computed it wrong: 2 instead of 1");
  }
  EXPECT_EQ(wrong.runs, 1);
}

}  // namespace
}  // namespace vsglbench
