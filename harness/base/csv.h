// Tables as text: RFC 4180, but that a line ends with "\n" alone, as every reader takes it.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

namespace vsglbench {

// One line. A cell with a comma, a quotation mark or a line break stands in quotes, its own quotes doubled.
std::string csv_row(const std::vector<std::string>& cells);

// Numbers in as many digits as they need.
template <class... Cells>
std::string csv_row(const Cells&... cells) {
  return csv_row(std::vector<std::string>{fmt::format("{}", cells)...});
}

// The cells of all lines: what csv_row wrote, read again. "\r\n" ends a line, too.
std::vector<std::vector<std::string>> parse_csv(std::string_view text);

}  // namespace vsglbench
