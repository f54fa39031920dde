// "did you mean": the known name closest to a mistyped one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vsglbench {

// Levenshtein distance in single-character edits; upper and lower case are one.
size_t edit_distance(std::string_view a, std::string_view b);

// The known name with the least edit distance; empty when `known` is empty.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

// "; did you mean 'x'?" or, when nothing is close, "; known: a, b, c".
std::string suggestion(std::string_view name, const std::vector<std::string>& known);

}  // namespace vsglbench
