// Arguments of an operation as CSV.
#pragma once

#include <istream>
#include <string>
#include <vector>

#include "operation/sg_evaluation.h"

namespace vsglbench {

// The rows of a CSV text whose header is the function's columns, row-major, each within its domain. A
// byte-order mark before the header is skipped. Throws Error(usage) "NAME:LINE: what".
std::vector<float> parse_sg_rows(const SgQuestion& question, const std::string& name, std::istream& text);

}  // namespace vsglbench
