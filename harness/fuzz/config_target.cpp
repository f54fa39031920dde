#include <algorithm>

#include "fuzz/input.h"
#include "fuzz/targets.h"
#include "run/config.h"

namespace vsglbench::fuzz {

bool read_config(Bytes bytes) {
  const auto zero = std::ranges::find(bytes, 0);
  const auto length = static_cast<size_t>(zero - bytes.begin());
  const bool has_preset = length < bytes.size();
  if (has_preset) write_input("configs/presets/p.json", bytes.first(length));
  const auto path = write_input("config.json", has_preset ? bytes.subspan(length + 1) : bytes);
  return accepts([&] { load_config(path); });
}

}  // namespace vsglbench::fuzz
