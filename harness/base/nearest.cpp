#include "base/nearest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>

#include "base/printable.h"

namespace vsglbench {
namespace {
constexpr size_t kMostKnown = 60;  // of a list of names in a message
}

size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const bool same = std::tolower(static_cast<unsigned char>(a[i - 1])) ==
                        std::tolower(static_cast<unsigned char>(b[j - 1]));
      const size_t substituted = diagonal + !same;
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& known) {
  name = name.substr(0, kExcerpt);  // the time taken is a product of lengths
  const auto it = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return edit_distance(name, a) < edit_distance(name, b);
  });
  return it == known.end() ? std::string() : *it;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(name, known);
  if (nearest.empty()) return "; none is known here";
  name = name.substr(0, kExcerpt);
  if (edit_distance(name, nearest) <= std::max<size_t>(2, name.size() / 2)) {
    return fmt::format("; did you mean '{}'?", excerpt(nearest));
  }
  std::string list;
  const size_t shown = std::min(known.size(), kMostKnown);
  for (size_t i = 0; i < shown; ++i) list += (i > 0 ? ", " : "") + excerpt(known[i]);
  return fmt::format("; known: {}{}", list,
                     shown < known.size() ? fmt::format(" and {} more", known.size() - shown) : "");
}

}  // namespace vsglbench
