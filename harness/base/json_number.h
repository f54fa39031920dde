// Whole numbers in JSON, with a fraction of 0 or without.
#pragma once

#include "base/json.h"

namespace vsglbench {

// Whether a number has no fraction, which makes it an integer in JSON Schema: 16 and 16.0.
bool is_whole(const Json& value);
// The value with every whole number in it written as one: 16.0 as 16.
Json with_integers(Json value);

}  // namespace vsglbench
