// Text for a terminal.
#pragma once

#include <string>

namespace vsglbench {

// UTF-8 text without what steers a terminal: control characters of either set (C0, DEL, C1) and marks of
// direction become spaces, and each byte that is no UTF-8, which a terminal may take for one of C1, four
// characters: \x9b. For what a file, a path or an argument brings.
std::string printable(const std::string& text);
// The same of each line; their ends stay.
std::string printable_lines(const std::string& text);

}  // namespace vsglbench
