// All that a schema refuses of a file, where check_schema() (base/json.h) throws the first.
#pragma once

#include <string>
#include <vector>

#include "base/json.h"

namespace vsglbench {

struct SchemaViolation {
  std::string pointer, message;  // as JsonDocument::error() takes them
};

// Of `doc`'s root, in the order of the file.
std::vector<SchemaViolation> all_violations(const JsonDocument& doc, const Json& schema);

}  // namespace vsglbench
