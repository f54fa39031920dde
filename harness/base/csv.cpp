#include "base/csv.h"

#include <fmt/ranges.h>

namespace vsglbench {
namespace {

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string out(1, '"');
  for (const char c : cell) out.append(c == '"' ? 2 : 1, c);
  return out += '"';
}

}  // namespace

std::string csv_row(const std::vector<std::string>& cells) {
  std::vector<std::string> written;
  for (const auto& cell : cells) written.push_back(quoted(cell));
  return fmt::format("{}\n", fmt::join(written, ","));
}

std::vector<std::vector<std::string>> parse_csv(std::string_view text) {
  std::vector<std::vector<std::string>> rows;
  bool in_quotes = false, in_row = false;
  for (size_t i = 0; i < text.size(); ++i) {
    if (!in_row) rows.push_back({""});
    in_row = true;
    const char c = text[i], next = i + 1 < text.size() ? text[i + 1] : '\0';
    if (in_quotes && c == '"' && next == '"') {
      rows.back().back() += text[++i];
    } else if (c == '"') {
      in_quotes = !in_quotes;
    } else if (!in_quotes && c == ',') {
      rows.back().emplace_back();
    } else if (!in_quotes && (c == '\n' || (c == '\r' && next == '\n'))) {
      i += c == '\r';
      in_row = false;
    } else {
      rows.back().back() += c;
    }
  }
  return rows;
}

}  // namespace vsglbench
