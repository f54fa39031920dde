// Sorting keys with a payload: cluster ids, as k-means has them, and full 32-bit keys.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "measure/blocks.h"
#include "measure/stopwatch.h"
#include "method/radix_sort.h"

namespace vsglbench {
namespace {

constexpr uint32_t kClusters = 2048;  // lights on the G-buffer [MFIS16 §5]; ids 0 … 2048 take 12 bits

class SortBlock : public Block {
 public:
  explicit SortBlock(Device& device) : on_(device) {}
  std::string name() const override { return "sort"; }
  std::string counted() const override { return "keys"; }
  std::vector<std::string> inputs() const override { return {"ids in runs", "ids at random", "32-bit keys"}; }
  std::vector<uint64_t> sizes() const override { return {1 << 14, 1 << 16, 262144, 1 << 20, 2088960}; }

  std::vector<Contestant> prepare(const std::string& input, uint64_t size) override {
    make_keys(input, static_cast<uint32_t>(size));
    bits_ = input == "32-bit keys" ? 32 : 12;
    for (Buffer* b : {&keys_, &values_, &keys2_, &values2_}) *b = Buffer(on_.device, "pairs", size * 4);
    std::vector<Contestant> all;
    for (const RadixVariant v : {RadixVariant::serial, RadixVariant::tile}) {
      const char* variant = v == RadixVariant::serial ? "serial" : "tile";
      all.push_back({variant, true, [this, v] { return sort_on_device(v); }, [this] { return mistake(); }});
    }
    all.push_back({"std::sort", false, [this] { return sort_on_host(); }, [this] { return mistake(); }});
    return all;
  }

 private:
  void make_keys(const std::string& input, uint32_t size) {
    std::mt19937 random(7);
    pairs_.resize(size);
    const uint32_t width = image_size(size).first;
    for (uint32_t i = 0; i < size; ++i) {
      // Clusters of an image: 64 × 32 cells, each a run in every row that it spans.
      const uint64_t x = i % width, y = i / width, rows = size / width;
      const auto cell = static_cast<uint32_t>(y * 32 / rows * 64 + x * 64 / width);
      pairs_[i] = {input == "ids in runs"     ? cell
                   : input == "ids at random" ? random() % kClusters
                                              : random(),
                   i};
    }
    expected_ = pairs_;
    std::stable_sort(expected_.begin(), expected_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
  }

  double sort_on_device(RadixVariant variant) {
    std::vector<uint32_t> words(pairs_.size());
    std::ranges::transform(pairs_, words.begin(), [](const auto& p) { return p.first; });
    keys_.upload(std::span<const uint32_t>(words));
    std::iota(words.begin(), words.end(), 0u);
    values_.upload(std::span<const uint32_t>(words));
    RadixSort sort(on_.context, variant);
    RadixSort::Pairs sorted;
    const auto count = static_cast<uint32_t>(pairs_.size());
    const double ms = device_ms(on_.recorder, [&] {
      sorted = sort.record(on_.recorder, {&keys_, &values_}, {&keys2_, &values2_}, count, bits_);
    });
    result_.resize(count);
    const auto keys = sorted.keys->download<uint32_t>(count),
               values = sorted.values->download<uint32_t>(count);
    for (size_t i = 0; i < count; ++i) result_[i] = {keys[i], values[i]};
    return ms;
  }

  double sort_on_host() {
    std::vector<uint64_t> packed(pairs_.size());
    std::ranges::transform(pairs_, packed.begin(),
                           [](const auto& p) { return uint64_t{p.first} << 32 | p.second; });
    const Stopwatch watch;
    std::sort(packed.begin(), packed.end());
    const double ms = watch.milliseconds();
    result_.resize(packed.size());
    std::ranges::transform(packed, result_.begin(), [](uint64_t p) {
      return std::pair(static_cast<uint32_t>(p >> 32), static_cast<uint32_t>(p));
    });
    return ms;
  }

  std::string mistake() const {
    const auto [a, b] = std::ranges::mismatch(result_, expected_);
    if (a == result_.end() && b == expected_.end()) return "";
    return fmt::format("place {} differs from std::stable_sort", a - result_.begin());
  }

  BlockDevice on_;
  std::vector<std::pair<uint32_t, uint32_t>> pairs_, expected_, result_;
  Buffer keys_, values_, keys2_, values2_;
  uint32_t bits_ = 32;
};

}  // namespace

std::unique_ptr<Block> make_sort_block(Device& device) { return std::make_unique<SortBlock>(device); }

}  // namespace vsglbench
