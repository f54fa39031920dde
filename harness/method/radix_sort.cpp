#include "method/radix_sort.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "base/error.h"
#include "gpu/limits.h"

namespace vsglbench {
namespace {

constexpr uint32_t kTileKeys = 2048, kLeastSubgroup = 8;  // as in shaders/radix_tile.glsl
// Keys of a run, of which an invocation takes 4 a round.
constexpr uint32_t kMostRun = 1u << 17;
static_assert(kMostRun / 4 < limits::loop_rounds);

void check(RadixSort::Pairs input, RadixSort::Pairs scratch, uint32_t count, uint32_t bits,
           bool needs_input) {
  if (bits < 1 || bits > 32) throw std::logic_error(fmt::format("radix sort by {} bits; 1 to 32", bits));
  const auto see = [&](const Buffer* buffer, const char* name) {
    if (!buffer) throw std::logic_error(fmt::format("radix sort: no {}", name));
    if (buffer->size() < size_t(count) * 4)
      throw std::logic_error(
          fmt::format("radix sort: {} bytes of {} for {} pairs", buffer->size(), name, count));
  };
  see(input.keys, "input keys");
  see(scratch.keys, "scratch keys");
  see(scratch.values, "scratch values");
  if (needs_input || input.values) see(input.values, "input values");
}

}  // namespace

RadixVariant choose_radix_variant(const DeviceInfo& info) {
  return info.type != "cpu" && info.subgroup_size >= 16 ? RadixVariant::tile : RadixVariant::serial;
}

// Digits of 12 bits save a CPU passes, and 32 runs keep their counters (2 KiB to 16 KiB each) in its caches;
// a GPU needs thousands of runs, each with fewer counters.
RadixSort::RadixSort(MethodContext& context, RadixVariant variant)
    : context_(context),
      variant_(variant),
      lanes_(context.device().is_cpu() ? 8 : 64),
      max_groups_(context.device().is_cpu() ? 4 : 64),
      digit_bits_(variant == RadixVariant::serial && context.device().is_cpu() ? 12 : 8) {
  if (variant == RadixVariant::tile && context.device().info().subgroup_size < kLeastSubgroup)
    throw std::logic_error(fmt::format("radix sort by tiles needs subgroups of at least {}", kLeastSubgroup));
  const bool serial = variant == RadixVariant::serial;
  const ShaderDefines defines = serial ? ShaderDefines{{"LANES", std::to_string(lanes_)}} : ShaderDefines{};
  ShaderDefines index_defines = defines;
  index_defines.emplace("INDEX_PAYLOAD", "1");
  const std::string prefix = serial ? "radix_serial_" : "radix_tile_";
  count_ = &context.shared_kernel(prefix + "count.comp", defines);
  totals_ = &context.shared_kernel(prefix + (serial ? "totals.comp" : "rows.comp"), defines);
  starts_ = &context.shared_kernel("radix_starts.comp");
  if (serial) offsets_ = &context.shared_kernel(prefix + "offsets.comp", defines);
  scatter_ = &context.shared_kernel(prefix + "scatter.comp", defines);
  scatter_index_ = &context.shared_kernel(prefix + "scatter.comp", index_defines);
}

RadixSort::Pairs RadixSort::record(Recorder& recorder, Pairs input, Pairs scratch, uint32_t count,
                                   uint32_t bits, Payload payload) {
  const uint32_t digits = passes(std::clamp(bits, 1u, 32u));
  check(input, scratch, count, bits, payload == Payload::values || digits > 1);
  if (count == 0) return input.values ? input : scratch;
  // Digits as even as can be: 32 bits as 11, 11, 10.
  uint32_t shift = 0;
  for (uint32_t pass = 0; pass < digits; ++pass) {
    const Digit digit{shift, groups_for(bits - shift, digits - pass)};
    const bool index = pass == 0 && payload == Payload::index;
    const auto record_pass =
        variant_ == RadixVariant::serial ? &RadixSort::record_serial : &RadixSort::record_tile;
    (this->*record_pass)(recorder, input, scratch, count, digit, index);
    shift += digit.bits;
    std::swap(input, scratch);
  }
  return input;
}

const Buffer& RadixSort::table(size_t bytes, const char* name) {
  const size_t size = std::bit_ceil(bytes);
  return context_.scratch(fmt::format("radix.{}.{}", name, size), size);
}

void RadixSort::record_serial(Recorder& r, Pairs from, Pairs to, uint32_t count, Digit digit, bool index) {
  const uint32_t bins = 1u << digit.bits;
  // Runs of at least as many keys as they have counters, so that small sorts don't drown in counters.
  uint32_t groups = std::clamp(count / (lanes_ * bins), 1u, max_groups_);
  groups = std::max(groups, groups_for(count, lanes_ * kMostRun));
  const uint32_t length = groups_for(groups_for(count, groups * lanes_), 4) * 4;
  const Buffer& counters = table(size_t(groups) * lanes_ * bins * 4);
  const Buffer& starts = table(bins * 4, "starts");
  const struct { uint32_t count, length, shift, bins; } runs{count, length, digit.shift, bins};
  const struct { uint32_t groups, bins; } table{groups, bins};
  // 1. Digits of each run.
  r.fill(counters, 0);
  r.barrier();
  r.dispatch(*count_, {*from.keys, counters}, runs, groups);
  r.barrier();
  // 2, 3. Where each bin starts.
  r.dispatch(*totals_, {counters, starts}, table, groups_for(bins, 64));
  r.barrier();
  r.dispatch(*starts_, {starts}, bins, 1);
  r.barrier();
  // 4. Where each run's part of a bin starts.
  r.dispatch(*offsets_, {counters, starts}, table, groups_for(bins, 64));
  r.barrier();
  // 5. Each pair to its place.
  r.dispatch(index ? *scatter_index_ : *scatter_,
             {*from.keys, index ? *from.keys : *from.values, counters, *to.keys, *to.values}, runs, groups);
  r.barrier();
}

void RadixSort::record_tile(Recorder& r, Pairs from, Pairs to, uint32_t count, Digit digit, bool index) {
  const uint32_t bins = 1u << digit.bits, tiles = groups_for(count, kTileKeys);
  const Buffer& counts = table(size_t(tiles) * bins * 4);
  const Buffer& starts = table(bins * 4, "starts");
  const struct { uint32_t count, tiles, shift, bits; } push{count, tiles, digit.shift, digit.bits};
  // 1. Each tile's histogram.
  r.dispatch(*count_, {*from.keys, counts}, push, tiles);
  r.barrier();
  // 2, 3. Where each tile's part of a bin starts within the bin, and where each bin starts.
  r.dispatch(*totals_, {counts, starts}, push, bins);
  r.barrier();
  r.dispatch(*starts_, {starts}, bins, 1);
  r.barrier();
  // 4. Each pair to its place.
  r.dispatch(index ? *scatter_index_ : *scatter_,
             {*from.keys, index ? *from.keys : *from.values, counts, starts, *to.keys, *to.values}, push,
             tiles);
  r.barrier();
}

}  // namespace vsglbench
