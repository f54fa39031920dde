// Stable radix sort of (key, value) pairs of 32 bits each on the device.
//
// Least significant digit first, as in [MFIS16 App. D], which sorts texels by cluster; each pass is a
// counting sort by one digit. Sources: Zagha and Blelloch 1991 (runs with private counters: `serial`); Satish
// et al. 2009 and Ashkiani et al. 2016 (tiles ranked by ballots: `tile`).
#pragma once

#include "gpu/recorder.h"
#include "method/context.h"

namespace vsglbench {

enum class RadixVariant {
  serial,  // no subgroup operations, no atomics: each invocation counts and moves one contiguous run of keys
  tile,    // each workgroup counts and moves one tile of keys, ranked by subgroup ballots
};

// `tile` where a device is wide (a GPU whose subgroups have at least 16 invocations); `serial` on a CPU,
// where few invocations run at a time and ballots and shared memory cost more than the memory they save.
RadixVariant choose_radix_variant(const DeviceInfo& info);

class RadixSort {
 public:
  // What the first pass takes for values: the value buffer, or each key's index (the buffer is not read).
  enum class Payload { values, index };
  struct Pairs {
    const Buffer* keys = nullptr;    // uint32
    const Buffer* values = nullptr;  // uint32
  };

  RadixSort(MethodContext& context, RadixVariant variant);
  explicit RadixSort(MethodContext& context)
      : RadixSort(context, choose_radix_variant(context.device().info())) {}

  // Sorts `count` pairs by the low `bits` bits (1 to 32) of their keys, inside the recorder's current pass,
  // which must make `input` visible; the result is visible to what is recorded after. It stands in the
  // returned buffers: those of `input` or those of `scratch`, and both are overwritten (`input` only where
  // there is more than one pass). Each buffer holds at least `count` words. input.values may be null for
  // Payload::index in one pass. Throws std::logic_error for bits outside 1..32, a buffer that is missing or
  // too small. Uses scratch buffers "radix.*" of the context; sorts may be recorded one after the other.
  Pairs record(Recorder& recorder, Pairs input, Pairs scratch, uint32_t count, uint32_t bits,
               Payload payload = Payload::values);

  // Passes over the pairs that a sort by `bits` bits takes.
  uint32_t passes(uint32_t bits) const { return groups_for(bits, digit_bits_); }

 private:
  struct Digit {
    uint32_t shift, bits;
  };
  // A scratch buffer of a power of two of bytes, which its name tells: it never grows, so commands that were
  // recorded earlier keep theirs.
  const Buffer& table(size_t bytes, const char* name = "counters");
  void record_serial(Recorder& recorder, Pairs from, Pairs to, uint32_t count, Digit digit, bool index);
  void record_tile(Recorder& recorder, Pairs from, Pairs to, uint32_t count, Digit digit, bool index);

  MethodContext& context_;
  RadixVariant variant_;
  uint32_t lanes_;       // serial: invocations a workgroup
  uint32_t max_groups_;  // serial: workgroups at most
  uint32_t digit_bits_;  // of one pass, at most
  const Kernel *count_, *totals_, *starts_, *offsets_ = nullptr, *scatter_, *scatter_index_;
};

}  // namespace vsglbench
