#include "base/pattern.h"

#include <stdexcept>
#include <string>

namespace vsglbench {

// Recursive descent over a pattern, which is the project's own and short. Each part is built from its end: it
// is told what follows it, and returns its first state.
class PatternParser {
 public:
  PatternParser(std::string_view text, std::vector<Pattern::State>* states) : text_(text), states_(*states) {}

  size_t whole() {
    const size_t match = add({.kind = Kind::match});
    const size_t start = alternatives(match);
    if (at_ < text_.size()) throw unsupported();
    return start;
  }

 private:
  using Kind = Pattern::State::Kind;

  size_t add(const Pattern::State& state) {
    states_.push_back(state);
    return states_.size() - 1;
  }
  bool is_next(char c) const { return at_ < text_.size() && text_[at_] == c; }
  bool take(char c) { return is_next(c) && ++at_; }
  char take_any() {
    if (at_ == text_.size()) throw unsupported();
    return text_[at_++];
  }
  std::logic_error unsupported() const {
    return std::logic_error("pattern '" + std::string(text_) + "': not understood at " + std::to_string(at_));
  }

  size_t alternatives(size_t next) {
    size_t start = sequence(next);
    while (take('|')) start = add({.kind = Kind::fork, .next = start, .other = sequence(next)});
    return start;
  }

  // Its parts are found first, then built from the last to the first.
  size_t sequence(size_t next) {
    std::vector<std::pair<size_t, size_t>> parts;  // from, to: an atom with what repeats it
    while (at_ < text_.size() && !is_next('|') && !is_next(')')) {
      const size_t from = at_;
      skip_atom();
      skip_repeat();
      parts.emplace_back(from, at_);
    }
    const size_t end = at_;
    for (auto it = parts.rbegin(); it != parts.rend(); ++it) next = repeated(it->first, next);
    at_ = end;
    return next;
  }

  void skip_atom() {
    const char c = take_any();
    if (c == '\\') {
      take_any();
    } else if (c == '[') {
      take('^');
      take(']');
      while (take_any() != ']') {
      }
    } else if (c == '(') {
      for (int depth = 1; depth > 0;) {
        if (is_next('(')) ++depth;
        if (is_next(')')) --depth;
        if (is_next('[') || is_next('\\')) {
          skip_atom();
        } else {
          take_any();
        }
      }
    }
  }

  struct Repeat {
    size_t least = 1, most = 1;
    bool unbounded = false;
  };

  Repeat skip_repeat() {
    if (take('*')) return {0, 0, true};
    if (take('+')) return {1, 1, true};
    if (take('?')) return {0, 1, false};
    if (!take('{')) return {};
    Repeat r;
    r.least = r.most = number();
    if (take(',')) {
      if (is_next('}')) {
        r.unbounded = true;
      } else {
        r.most = number();
      }
    }
    if (!take('}') || r.most < r.least) throw unsupported();
    return r;
  }

  size_t number() {
    constexpr size_t kMost = 1000;
    size_t n = 0, digits = 0;
    for (; at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9' && n <= kMost; ++digits)
      n = 10 * n + static_cast<size_t>(take_any() - '0');
    if (digits == 0 || n > kMost) throw unsupported();
    return n;
  }

  // The atom that stands at `from`, as often as what follows it says.
  size_t repeated(size_t from, size_t next) {
    at_ = from;
    skip_atom();
    const Repeat repeat = skip_repeat();
    const auto atom_before = [&](size_t state) {
      at_ = from;
      return atom(state);
    };
    if (repeat.unbounded) {
      const size_t loop = add({.kind = Kind::fork, .other = next});
      states_[loop].next = atom_before(loop);
      next = loop;
    }
    for (size_t i = repeat.least; i < repeat.most; ++i)
      next = add({.kind = Kind::fork, .next = atom_before(next), .other = next});
    for (size_t i = 0; i < repeat.least; ++i) next = atom_before(next);
    return next;
  }

  size_t atom(size_t next) {
    Pattern::State state{.kind = Kind::bytes, .next = next};
    const char c = take_any();
    if (c == '(') {
      const size_t start = alternatives(next);
      if (!take(')')) throw unsupported();
      return start;
    }
    if (c == '^') state.kind = Kind::begin;
    if (c == '$') state.kind = Kind::end;
    if (c == '*' || c == '+' || c == '?' || c == '{') throw unsupported();
    if (c == '.') {
      state.bytes.set();
    } else if (c == '[') {
      state.bytes = set();
    } else {
      state.bytes.set(static_cast<unsigned char>(c == '\\' ? escaped() : c));
    }
    return add(state);
  }

  // No \d and the like.
  char escaped() {
    const char c = take_any();
    const bool is_class = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (is_class) throw unsupported();
    return c;
  }

  Pattern::Bytes set() {
    Pattern::Bytes bytes;
    const bool negated = take('^');
    for (bool first = true; first || !is_next(']'); first = false) {
      const auto low = static_cast<unsigned char>(is_next('\\') ? (++at_, escaped()) : take_any());
      size_t high = low;
      if (at_ + 1 < text_.size() && is_next('-') && text_[at_ + 1] != ']') {
        ++at_;
        high = static_cast<unsigned char>(take_any());
      }
      for (size_t b = low; b <= high; ++b) bytes.set(b);
    }
    ++at_;
    return negated ? ~bytes : bytes;
  }

  std::string_view text_;
  std::vector<Pattern::State>& states_;
  size_t at_ = 0;
};

Pattern::Pattern(std::string_view pattern) { start_ = PatternParser(pattern, &states_).whole(); }

// Lists `state` and all that it leads to without a byte.
void Pattern::follow(size_t state, bool at_begin, bool at_end, std::vector<size_t>* list,
                     std::vector<bool>* listed) const {
  std::vector<size_t> open = {state};
  while (!open.empty()) {
    const size_t i = open.back();
    open.pop_back();
    if ((*listed)[i]) continue;
    (*listed)[i] = true;
    list->push_back(i);
    const State& s = states_[i];
    using Kind = State::Kind;
    if (s.kind == Kind::fork) open.insert(open.end(), {s.next, s.other});
    if ((s.kind == Kind::begin && at_begin) || (s.kind == Kind::end && at_end)) open.push_back(s.next);
  }
}

bool Pattern::search(std::string_view text) const {
  std::vector<size_t> now, then;
  std::vector<bool> listed(states_.size());
  for (size_t i = 0;; ++i) {
    const bool at_end = i == text.size();
    // What went on from the last byte, and a match that begins here.
    std::vector<size_t> starts = std::move(then);
    starts.push_back(start_);
    now.clear();
    listed.assign(states_.size(), false);
    for (const size_t s : starts) follow(s, i == 0, at_end, &now, &listed);
    then.clear();
    for (const size_t s : now) {
      if (states_[s].kind == State::Kind::match) return true;
      if (!at_end && states_[s].kind == State::Kind::bytes &&
          states_[s].bytes[static_cast<unsigned char>(text[i])])
        then.push_back(states_[s].next);
    }
    if (at_end) return false;
  }
}

}  // namespace vsglbench
