#include "measure/block_map.h"

#include <fmt/format.h>

#include <cmath>
#include <thread>

#include "base/error.h"
#include "base/log.h"
#include "base/nearest.h"
#include "measure/blocks.h"
#include "measure/stopwatch.h"

namespace vsglbench {
namespace {

// Makes the contestants and runs each once; the first run also compiles. What the device has no room for;
// empty: nothing. A result is looked at before it is timed: a wrong one throws.
std::string try_out(Block& block, const std::string& input, uint64_t size, const std::string& where,
                    std::vector<Contestant>* contestants) {
  std::string wrong;
  try {
    *contestants = block.prepare(input, size);
    for (const Contestant& c : *contestants) {
      c.run_ms();
      const std::string mistake = c.mistake();
      if (!mistake.empty() && wrong.empty())
        wrong = fmt::format("{}: {} computed it wrong: {}", where, c.name, mistake);
    }
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::case_failed) throw;
    return e.what();
  }
  if (!wrong.empty()) throw Error(ErrorKind::case_failed, wrong);
  return "";
}

// Every contestant `repetitions` times, in turn.
std::vector<std::vector<double>> time_in_turn(const std::vector<Contestant>& contestants, int repetitions) {
  std::vector<std::vector<double>> ms(contestants.size());
  for (int i = 0; i < repetitions; ++i) {
    for (size_t k = 0; k < contestants.size(); ++k) ms[k].push_back(contestants[k].run_ms());
  }
  return ms;
}

void add_growth(const std::string& input, const std::vector<Contestant>& contestants, BlockMap* map) {
  for (const Contestant& c : contestants) {
    std::vector<std::pair<double, double>> points;
    for (const BlockTime& t : map->times) {
      if (t.input != input || t.contestant != c.name || !(t.ms.median > 0)) continue;
      points.emplace_back(static_cast<double>(t.size), t.ms.median);
    }
    if (points.size() >= 2) map->growth.push_back({input, c.name, growth_exponent(points)});
  }
}

// The fastest of the host's at the same input and size.
const BlockTime* counterpart(const BlockMap& map, const BlockTime& of) {
  const BlockTime* best = nullptr;
  for (const BlockTime& t : map.times) {
    if (t.on_device || t.input != of.input || t.size != of.size) continue;
    if (!best || t.ms.median < best->ms.median) best = &t;
  }
  return best;
}

double million_a_second(const BlockTime& t) {
  return t.ms.median > 0 ? static_cast<double>(t.size) / t.ms.median * 1e-3 : 0;
}

// "-" where the host's time would be shown as 0.000 ms: no ratio of it is worth showing.
std::string ratio_text(double ms, double host_ms) {
  return host_ms >= 0.0005 ? fmt::format("{:.2f}", ms / host_ms) : "-";
}

}  // namespace

std::vector<std::string> block_names() { return {"sort", "nearest", "sum", "warp", "mipmap"}; }

std::unique_ptr<Block> make_block(Device& device, const std::string& name) {
  if (name == "sort") return make_sort_block(device);
  if (name == "nearest") return make_nearest_block(device);
  if (name == "sum") return make_sum_block(device);
  if (name == "warp") return make_warp_block(device);
  if (name == "mipmap") return make_mipmap_block(device);
  throw fail(ErrorKind::usage, "no building block '{}'{}", name, suggestion(name, block_names()));
}

BlockMap measure_block(Block& block, const std::vector<uint64_t>& sizes, int repetitions) {
  BlockMap map{block.name(), block.counted(), {}, {}, {}};
  for (const auto& input : block.inputs()) {
    std::vector<Contestant> contestants;
    for (const uint64_t size : sizes) {
      const std::string where = fmt::format("{}, {}, {} {}", map.block, input, size, map.counted);
      log_info("{}", where);
      if (const auto why = try_out(block, input, size, where, &contestants); !why.empty()) {
        map.skipped.push_back(fmt::format("{}, {} {}: {}", input, size, map.counted, why));
        continue;
      }
      const auto ms = time_in_turn(contestants, repetitions);
      for (size_t k = 0; k < contestants.size(); ++k) {
        map.times.push_back({input, contestants[k].name, contestants[k].on_device, size, summarize(ms[k])});
      }
    }
    add_growth(input, contestants, &map);
  }
  return map;
}

double growth_exponent(const std::vector<std::pair<double, double>>& points) {
  double mean_x = 0, mean_y = 0, xy = 0, xx = 0;
  for (const auto& [size, ms] : points) {
    mean_x += std::log(size) / static_cast<double>(points.size());
    mean_y += std::log(ms) / static_cast<double>(points.size());
  }
  for (const auto& [size, ms] : points) {
    xy += (std::log(size) - mean_x) * (std::log(ms) - mean_y);
    xx += (std::log(size) - mean_x) * (std::log(size) - mean_x);
  }
  return xy / xx;
}

std::string block_table(const BlockMap& map) {
  std::string out = fmt::format("{:<22} {:<22} {:>9} {:>10} {:>21} {:>12} {:>16}\n", map.block, "",
                                map.counted, "ms", "95 % interval", "million/s", "time/host's time");
  for (const BlockTime& t : map.times) {
    const BlockTime* host = counterpart(map, t);
    const std::string ratio = t.on_device && host ? ratio_text(t.ms.median, host->ms.median) : "";
    out += fmt::format("{:<22} {:<22} {:>9} {:>10.3f} {:>21} {:>12.1f} {:>16}\n", t.input, t.contestant,
                       t.size, t.ms.median, fmt::format("{:.3f} … {:.3f}", t.ms.ci95.lo, t.ms.ci95.hi),
                       million_a_second(t), ratio);
  }
  for (const Growth& g : map.growth) {
    out += fmt::format("{:<22} {:<22} grows as size^{:.2f}\n", g.input, g.contestant, g.exponent);
  }
  for (const auto& skipped : map.skipped) out += "skipped: " + skipped + "\n";
  return out;
}

Json to_json(const BlockMap& map) {
  Json times = Json::array(), growth = Json::array();
  for (const BlockTime& t : map.times) {
    times.push_back({{"input", t.input},
                     {"contestant", t.contestant},
                     {"on_device", t.on_device},
                     {"size", t.size},
                     {"samples_ms", t.ms.samples},
                     {"median_ms", t.ms.median},
                     {"ci95_ms", {t.ms.ci95.lo, t.ms.ci95.hi}},
                     {"million_per_s", million_a_second(t)}});
  }
  for (const Growth& g : map.growth) {
    growth.push_back({{"input", g.input}, {"contestant", g.contestant}, {"exponent", g.exponent}});
  }
  return {{"block", map.block},
          {"counted", map.counted},
          {"times", times},
          {"growth", growth},
          {"skipped", map.skipped}};
}

double device_ms(Recorder& recorder, const std::function<void()>& record) {
  recorder.begin();
  recorder.pass({.step = "block"}, record);
  return recorder.submit_and_wait().span_ms;
}

double two_threads_ms(const std::function<void(int)>& part) {
  const Stopwatch watch;
  std::thread other([&] { part(1); });
  part(0);
  other.join();
  return watch.milliseconds();
}

std::pair<uint32_t, uint32_t> image_size(uint64_t texels) {
  if (texels == 1920 * 1088) return {1920, 1088};
  auto width = static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(texels))));
  while (texels % width != 0) ++width;
  return {width, static_cast<uint32_t>(texels / width)};
}

}  // namespace vsglbench
