#include "base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace vsglbench {
namespace {

// A character at the head of a text: what it is, and in how many bytes.
struct Character {
  uint32_t code;
  size_t length;  // 0: its first byte starts none that is well-formed [Unicode 15, table 3-7]
};

Character first_character(std::string_view text) {
  const auto byte = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const uint32_t first = byte(0);
  if (first < 0x80) return {first, 1};
  const size_t length = first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
  if (length == 0) return {0, 0};
  uint32_t code = first & (0x7Fu >> length);
  for (size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {0, 0};
    code = code << 6 | (byte(i) & 0x3F);
  }
  const bool shortest = code >= (length == 4 ? 0x10000u : length == 3 ? 0x800u : 0x80u);
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return {code, shortest && !surrogate && code <= 0x10FFFF ? length : 0};
}

bool steers(uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || (code >= 0x202A && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069);
}

}  // namespace

std::string printable(const std::string& text) {
  std::string out;
  for (std::string_view rest = text; !rest.empty();) {
    const Character c = first_character(rest);
    if (c.length == 0) {
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(rest[0]));
    } else if (c.code == '\n' || c.code == '\r' || c.code == '\t') {
      out += ' ';
    } else if (steers(c.code)) {
      out += c.code < 0x80 ? fmt::format("\\x{:02x}", c.code) : fmt::format("\\u{:04x}", c.code);
    } else {
      out += rest.substr(0, c.length);
    }
    rest.remove_prefix(std::max<size_t>(c.length, 1));
  }
  return out;
}

std::string printable_lines(const std::string& text) {
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    out += printable(text.substr(at, end - at));
    if (end < text.size()) out += '\n';
    at = end + 1;
  }
  return out;
}

std::string excerpt(const std::string& text, size_t most) {
  // No more is looked at than could be shown, from either end: a text may have megabytes.
  const size_t bytes = 4 * most;
  const bool is_long = text.size() > 2 * bytes;
  const std::string head = printable(is_long ? text.substr(0, bytes) : text);
  const auto starts = [](char c) { return (c & 0xC0) != 0x80; };
  const size_t count = static_cast<size_t>(std::count_if(head.begin(), head.end(), starts));
  if (!is_long && count <= most) return head;
  // Of what is shown, a fifth is the end: names often differ there alone.
  const size_t last = most / 5, first = most - last - 1;
  const std::string tail = is_long ? printable(text.substr(text.size() - bytes)) : head;
  size_t to = 0, from = tail.size();
  for (size_t n = 0; to < head.size() && (n < first || !starts(head[to])); ++to) n += starts(head[to]);
  for (size_t n = 0; from > 0 && n < last;) n += starts(tail[--from]);
  return head.substr(0, to) + "…" + tail.substr(from);
}

}  // namespace vsglbench
