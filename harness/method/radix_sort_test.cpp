// Both variants of the device's sort against std::stable_sort.
#include "method/radix_sort.h"

#include <algorithm>
#include <numeric>
#include <random>

#include "method/test_field.h"

using namespace vsglbench;

namespace {

using Keys = std::vector<uint32_t>;
enum class Order { random, equal, reversed, sorted, coherent };

Keys make_keys(uint32_t count, Order order) {
  std::mt19937 random(count + 17);
  Keys keys(count);
  for (uint32_t i = 0; i < count; ++i) {
    switch (order) {
      case Order::random:
        keys[i] = static_cast<uint32_t>(random());
        break;
      case Order::equal:
        keys[i] = 0xFFFFFFFFu;
        break;
      case Order::reversed:
        keys[i] = count - 1 - i;
        break;
      case Order::sorted:
        keys[i] = i / 3;
        break;
      case Order::coherent:
        keys[i] = (i % 1920) / 24 + 80 * (i / 1920 / 24);
        break;  // blocks of an image
    }
  }
  return keys;
}

class SortBench {
 public:
  explicit SortBench(RadixVariant variant)
      : kernels_(test_device()),
        scratch_(test_device()),
        context_(kernels_, scratch_, {}),
        recorder_(test_device()),
        sort_(context_, variant) {}

  RadixSort& sort() { return sort_; }
  Recorder& recorder() { return recorder_; }

  // Sorts (keys, values) and compares keys and values with std::stable_sort by the masked key.
  void expect_sorted(const Keys& keys, uint32_t bits, RadixSort::Payload payload) {
    const auto count = static_cast<uint32_t>(keys.size());
    Keys values(count);
    for (uint32_t i = 0; i < count; ++i) values[i] = payload == RadixSort::Payload::index ? i : ~i * 3;
    const auto [sorted_keys, sorted_values] = run(keys, values, bits, payload);

    const uint32_t mask = bits == 32 ? ~0u : (1u << bits) - 1;
    Keys order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return (keys[a] & mask) < (keys[b] & mask); });
    size_t wrong = 0, first = count;
    for (uint32_t i = count; i-- > 0;) {
      if (sorted_keys[i] == keys[order[i]] && sorted_values[i] == values[order[i]]) continue;
      ++wrong;
      first = i;
    }
    EXPECT_EQ(wrong, 0u) << count << " pairs by " << bits << " bits: first wrong at " << first;
  }

  std::pair<Keys, Keys> run(const Keys& keys, const Keys& values, uint32_t bits, RadixSort::Payload payload) {
    const auto count = static_cast<uint32_t>(keys.size());
    const size_t bytes = std::max<size_t>(keys.size(), 1) * 4;
    const bool given = payload == RadixSort::Payload::values;
    Buffer in_keys(test_device(), "keys", bytes), in_values(test_device(), "values", bytes);
    Buffer out_keys(test_device(), "keys2", bytes), out_values(test_device(), "values2", bytes);
    if (count > 0) in_keys.upload(std::span<const uint32_t>(keys));
    if (count > 0 && given) in_values.upload(std::span<const uint32_t>(values));
    recorder_.begin();
    RadixSort::Pairs sorted;
    recorder_.pass({.step = "sort"}, [&] {
      sorted =
          sort_.record(recorder_, {&in_keys, &in_values}, {&out_keys, &out_values}, count, bits, payload);
    });
    recorder_.submit_and_wait();
    if (count == 0) return {};
    return {sorted.keys->download<uint32_t>(count), sorted.values->download<uint32_t>(count)};
  }

 private:
  KernelLibrary kernels_;
  ScratchPool scratch_;
  MethodContext context_;
  Recorder recorder_;
  RadixSort sort_;
};

class RadixSortTest : public testing::TestWithParam<RadixVariant> {};

TEST_P(RadixSortTest, EverySizeOrderAndWidthIsAsStableSort) {
  SortBench bench(GetParam());
  for (const uint32_t count : {1u, 2u, 255u, 256u, 257u, 2047u, 2048u, 2049u, 65535u, 65536u, 65537u}) {
    for (const Order order : {Order::random, Order::equal, Order::reversed, Order::sorted, Order::coherent}) {
      const Keys keys = make_keys(count, order);
      bench.expect_sorted(keys, 10, RadixSort::Payload::index);
      bench.expect_sorted(keys, 32, RadixSort::Payload::values);
    }
  }
}

TEST_P(RadixSortTest, FullSizeHalves) {
  SortBench bench(GetParam());
  for (const uint32_t count : {262144u, 2088960u}) {
    const Keys random = make_keys(count, Order::random);
    bench.expect_sorted(random, 11, RadixSort::Payload::index);
    bench.expect_sorted(random, 32, RadixSort::Payload::values);
    bench.expect_sorted(make_keys(count, Order::coherent), 12, RadixSort::Payload::index);
  }
}

// More keys than a few runs can hold: the device may limit how long a loop is.
TEST_P(RadixSortTest, NineMillionKeys) {
  SortBench bench(GetParam());
  bench.expect_sorted(make_keys(9'000'001, Order::random), 8, RadixSort::Payload::index);
}

// Digits of every width, and what lies above the masked bits neither sorts nor is lost.
TEST_P(RadixSortTest, EveryNumberOfBits) {
  SortBench bench(GetParam());
  const Keys keys = make_keys(5003, Order::random);
  for (uint32_t bits = 1; bits <= 32; ++bits) {
    bench.expect_sorted(keys, bits, RadixSort::Payload::values);
    bench.expect_sorted(keys, bits, RadixSort::Payload::index);
  }
}

TEST_P(RadixSortTest, NoPairsAreNoWork) {
  SortBench bench(GetParam());
  EXPECT_TRUE(bench.run({}, {}, 32, RadixSort::Payload::values).first.empty());
  EXPECT_EQ(bench.recorder().dispatches(), 0u);
}

// Recorded one after the other in one submission, a larger sort leaves the buffers of a smaller one alone.
TEST_P(RadixSortTest, TwoSortsInOneSubmission) {
  SortBench bench(GetParam());
  const Keys small = make_keys(300, Order::random), large = make_keys(70000, Order::random);
  std::array<Buffer, 8> b;
  for (size_t i = 0; i < b.size(); ++i) b[i] = Buffer(test_device(), "pairs", (i < 4 ? 300 : 70000) * 4);
  b[0].upload(std::span<const uint32_t>(small));
  b[4].upload(std::span<const uint32_t>(large));
  RadixSort::Pairs first, second;
  bench.recorder().begin();
  bench.recorder().pass({.step = "sorts"}, [&] {
    const auto index = RadixSort::Payload::index;
    first = bench.sort().record(bench.recorder(), {&b[0], &b[1]}, {&b[2], &b[3]}, 300, 32, index);
    second = bench.sort().record(bench.recorder(), {&b[4], &b[5]}, {&b[6], &b[7]}, 70000, 32, index);
  });
  bench.recorder().submit_and_wait();
  Keys expected = small;
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(first.keys->download<uint32_t>(300), expected);
  expected = large;
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(second.keys->download<uint32_t>(70000), expected);
}

TEST_P(RadixSortTest, MisuseIsRefused) {
  SortBench bench(GetParam());
  const Buffer small(test_device(), "small", 16), enough(test_device(), "enough", 400);
  const auto record = [&](RadixSort::Pairs input, uint32_t bits) {
    bench.sort().record(bench.recorder(), input, {&enough, &enough}, 100, bits);
  };
  EXPECT_THROW(record({&enough, &enough}, 0), std::logic_error);
  EXPECT_THROW(record({&enough, &enough}, 33), std::logic_error);
  EXPECT_THROW(record({&small, &enough}, 8), std::logic_error);
  EXPECT_THROW(record({&enough, nullptr}, 8), std::logic_error);
}

INSTANTIATE_TEST_SUITE_P(Variants, RadixSortTest, testing::Values(RadixVariant::serial, RadixVariant::tile),
                         [](const auto& variant) {
                           return variant.param == RadixVariant::serial ? "Serial" : "Tile";
                         });

TEST(RadixVariants, AreChosenByDevice) {
  DeviceInfo info;
  info.type = "cpu";
  info.subgroup_size = 32;
  EXPECT_EQ(choose_radix_variant(info), RadixVariant::serial);
  info.type = "discrete";
  EXPECT_EQ(choose_radix_variant(info), RadixVariant::tile);
  info.subgroup_size = 8;
  EXPECT_EQ(choose_radix_variant(info), RadixVariant::serial);
}

}  // namespace
