#include "operation/sg_rows.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "base/error.h"
#include "base/printable.h"

namespace vsglbench {
namespace {

// What spreadsheets write before UTF-8.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// "a, b" to {"a", "b"}; spaces around a cell are no part of it.
std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> out;
  for (size_t at = 0; at <= line.size();) {
    const size_t end = std::min(line.find(',', at), line.size());
    std::string_view cell = line.substr(at, end - at);
    while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t')) cell.remove_prefix(1);
    while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t' || cell.back() == '\r'))
      cell.remove_suffix(1);
    out.push_back(cell);
    at = end + 1;
  }
  return out;
}

}  // namespace

std::vector<float> parse_sg_rows(const SgQuestion& q, const std::string& name, std::istream& text) {
  const std::vector<std::string>& columns = q.info().columns;
  std::vector<float> rows, row(columns.size());
  std::string line;
  size_t number = 0;
  const auto refuse = [&](const std::string& what) {
    return fail(ErrorKind::usage, "{}:{}: {}", name, number, what);
  };
  for (number = 1; std::getline(text, line); ++number) {
    if (number == 1 && line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
    const std::vector<std::string_view> read = cells(line);
    if (number == 1) {
      if (!std::equal(read.begin(), read.end(), columns.begin(), columns.end())) {
        throw refuse(fmt::format("the header is not \"{}\", the columns of {}", fmt::join(columns, ","),
                                 q.info().name));
      }
      continue;
    }
    if (read.size() == 1 && read[0].empty()) continue;
    if (read.size() != columns.size()) {
      throw refuse(fmt::format("{} values, not the {} of \"{}\"", read.size(), columns.size(),
                               fmt::join(columns, ",")));
    }
    for (size_t k = 0; k < read.size(); ++k) {
      double value = 0;
      const auto [end, error] = std::from_chars(read[k].data(), read[k].data() + read[k].size(), value);
      if (error != std::errc() || end != read[k].data() + read[k].size()) {
        throw refuse(fmt::format("{}: \"{}\" is not a number", columns[k], excerpt(std::string(read[k]))));
      }
      row[k] = static_cast<float>(value);
    }
    if (const std::string what = out_of_domain(q, row); !what.empty()) throw refuse(what);
    rows.insert(rows.end(), row.begin(), row.end());
  }
  if (number == 1) throw refuse(fmt::format("empty; the first line is \"{}\"", fmt::join(columns, ",")));
  return rows;
}

}  // namespace vsglbench
