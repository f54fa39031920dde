// Text for a terminal.
#pragma once

#include <cstddef>
#include <string>

namespace vsglbench {

// UTF-8 text without what steers a terminal: line ends and tabs become spaces; other control characters of
// either set (C0, DEL, C1) and marks of direction are written out, \x1b or \u202e, and so is each byte that
// is no UTF-8, which a terminal may take for one of C1: \x9b. For what a file, a path or an argument brings.
std::string printable(const std::string& text);
// The same of each line; their ends stay.
std::string printable_lines(const std::string& text);

// How much of one string of a file stands in a message, in characters.
inline constexpr size_t kExcerpt = 120;
// And of one message, whatever stands in it.
inline constexpr size_t kLongestMessage = 2000;
// Printable, and at most `most` characters: of a longer text its head, "…" and a little of its end.
std::string excerpt(const std::string& text, size_t most = kExcerpt);

}  // namespace vsglbench
