// Regular expressions of schemas. The library's own recurse at each character of a text: 26,000 of them are
// too many for a stack. Here a text takes time in proportion to its length and no stack at all.
#pragma once

#include <bitset>
#include <string_view>
#include <vector>

namespace vsglbench {

// Of ECMAScript's syntax what schemas use: characters and \escapes of them, ., [a-z], [^a-z], groups (...),
// alternatives |, *, +, ?, {n}, {n,m}, ^ and $; bytes, not characters. Anything else throws std::logic_error.
class Pattern {
 public:
  explicit Pattern(std::string_view pattern);
  // Whether any part of the text matches.
  bool search(std::string_view text) const;

 private:
  friend class PatternParser;
  using Bytes = std::bitset<256>;
  // A state of a nondeterministic automaton [Thompson 1968].
  struct State {
    enum class Kind { bytes, fork, begin, end, match } kind;
    Bytes bytes{};               // that lead on to `next`
    size_t next = 0, other = 0;  // fork: both
  };
  void follow(size_t state, bool at_begin, bool at_end, std::vector<size_t>* list,
              std::vector<bool>* listed) const;

  std::vector<State> states_;
  size_t start_ = 0;
};

}  // namespace vsglbench
