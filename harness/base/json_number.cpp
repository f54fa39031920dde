#include "base/json_number.h"

#include <cmath>
#include <utility>

namespace vsglbench {

bool is_whole(const Json& value) {
  if (value.is_number_integer()) return true;
  constexpr double kMost = 9007199254740992.0;  // past it doubles have no fractions left to lack
  return value.is_number_float() && std::abs(value.get<double>()) <= kMost &&
         value.get<double>() == std::floor(value.get<double>());
}

Json with_integers(Json value) {
  if (value.is_number_float() && is_whole(value)) return static_cast<int64_t>(value.get<double>());
  if (value.is_structured())
    for (Json& v : value) v = with_integers(std::move(v));
  return value;
}

}  // namespace vsglbench
