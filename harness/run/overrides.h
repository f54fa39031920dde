// `run --set KEY=VALUE`: a value of one of the keys that every case has, in place of the config's.
#pragma once

#include <string>
#include <vector>

#include "run/sweep.h"

namespace vsglbench {

// "N=64", "visibility=none", "rsm=[64,128]". Throws Error(config) for what is no KEY=VALUE, an unknown key
// (naming the nearest), a value that the key does not take, or a key that comes twice.
Overrides parse_overrides(const std::vector<std::string>& settings);

// Makes a config what it would be if it had said so for every entry: its own value is replaced, and none of
// its entries has another. Throws Error(config) for a key that the config's cases don't read.
void apply(const Overrides& overrides, Json* root);

// Throws Error(config) for a key that none of the cases has read.
void check_read(const Overrides& overrides, const std::vector<Case>& cases);

}  // namespace vsglbench
