// "2%" as a number.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace vsglbench {

// 2 for "2%" or "2 %"; nothing for anything else, a bare number included: whether it meant percent isn't
// said.
inline std::optional<double> parse_percent(std::string_view text) {
  if (!text.ends_with('%')) return std::nullopt;
  text.remove_suffix(1);
  if (text.ends_with(' ')) text.remove_suffix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace vsglbench
