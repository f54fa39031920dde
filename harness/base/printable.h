// Text for a terminal.
#pragma once

#include <string>

namespace vsglbench {

// UTF-8 text without what steers a terminal: control characters of either set (C0, DEL, C1) and marks of
// direction become spaces. For what a file, a path or an argument brings.
std::string printable(std::string text);
// The same of each line; their ends stay.
std::string printable_lines(const std::string& text);

}  // namespace vsglbench
