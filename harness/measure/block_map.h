// How long each building block of the methods takes over its size, on the device and on the host's cores in
// the same run. What it computes is checked before it is timed.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/json.h"
#include "gpu/recorder.h"
#include "measure/statistics.h"

namespace vsglbench {

// One of those that do the same work on the same input.
struct Contestant {
  std::string name;
  bool on_device = true;
  std::function<double()> run_ms;  // one repetition; device: GPU time, host: wall-clock time of its 2 threads
  std::function<std::string()> mistake;  // what is wrong with the last result; empty: nothing
};

// A building block with inputs made up for it.
class Block {
 public:
  virtual ~Block() = default;
  virtual std::string name() const = 0;
  virtual std::string counted() const = 0;  // what a size counts, "keys"
  virtual std::vector<std::string> inputs() const = 0;
  virtual std::vector<uint64_t> sizes() const = 0;
  // The contestants on one input; they live until the next call.
  virtual std::vector<Contestant> prepare(const std::string& input, uint64_t size) = 0;
};

std::vector<std::string> block_names();
// Throws Error(usage) naming the nearest.
std::unique_ptr<Block> make_block(Device& device, const std::string& name);

struct BlockTime {
  std::string input, contestant;
  bool on_device = true;
  uint64_t size = 0;
  Summary ms;
};
// time = c · size^exponent, by least squares on logarithms.
struct Growth {
  std::string input, contestant;
  double exponent = 0;
};
struct BlockMap {
  std::string block, counted;
  std::vector<BlockTime> times;
  std::vector<Growth> growth;  // none of a contestant with fewer than two sizes
  std::vector<std::string>
      skipped;  // "<input>, <size> <counted>: <why>", where the device has no room for it
};

// Every input × size: each contestant once, checked; then `repetitions` rounds of all of them in turn. An
// input that the device has no room for is skipped. Throws Error(case_failed) for a wrong result, naming
// input, size and contestant.
BlockMap measure_block(Block& block, const std::vector<uint64_t>& sizes, int repetitions);

// The exponent of a power law through (size, ms) points; sizes differ.
double growth_exponent(const std::vector<std::pair<double, double>>& points);

std::string block_table(const BlockMap& map);
Json to_json(const BlockMap& map);

// GPU time of what `record` records, as one pass.
double device_ms(Recorder& recorder, const std::function<void()>& record);
// Wall-clock time of part(0) and part(1), each in a thread of its own.
double two_threads_ms(const std::function<void(int)>& part);
// The size of an image of `texels` texels: 1920×1088 for 2,088,960, else as square as can be.
std::pair<uint32_t, uint32_t> image_size(uint64_t texels);

}  // namespace vsglbench
