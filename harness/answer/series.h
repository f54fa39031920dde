// Cases of a group that differ in one parameter alone.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "answer/point.h"

namespace vsglbench {

// Points by the value of one key: numbers by size, words in the report's order.
struct Series {
  std::vector<std::pair<Json, size_t>> points;  // value, and index in the group; at least one
};

// Keys of words and numbers that have more than one value in the group, by name.
std::vector<std::string> varied_keys(const PointGroup& group);

// One a method and choice of all else; cases without the key are in none.
std::vector<Series> series_over(const PointGroup& group, const std::string& key);

}  // namespace vsglbench
