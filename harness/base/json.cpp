#include "base/json.h"

#include "base/file.h"
#include "base/printable.h"

namespace vsglbench {
namespace {

// The line of the last character that is not white space and that the parser has consumed.
struct LineCounter {
  int newlines = 0, line = 1;
  void consume(char c) {
    if (c == '\n') {
      ++newlines;
    } else if (c != ' ' && c != '\t' && c != '\r') {
      line = newlines + 1;
    }
  }
};

struct CountingIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  const char* at = nullptr;
  LineCounter* counter = nullptr;
  reference operator*() const { return *at; }
  CountingIterator& operator++() {
    counter->consume(*at++);
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const CountingIterator& o) const { return at == o.at; }
  bool operator!=(const CountingIterator& o) const { return at != o.at; }
};

using Lines = std::map<std::string, int>;

// Builds the value and, where asked to, records a line for every pointer.
class Builder : public nlohmann::json_sax<Json> {
 public:
  // `lines`: null where they are not wanted.
  Builder(const LineCounter& counter, Lines* lines) : counter_(counter), lines_(lines) {}

  Json root;
  std::string problem;

  bool null() override { return put(nullptr); }
  bool boolean(bool v) override { return put(v); }
  bool number_integer(number_integer_t v) override { return put(v); }
  bool number_unsigned(number_unsigned_t v) override { return put(v); }
  bool number_float(number_float_t v, const string_t&) override { return put(v); }
  bool string(string_t& v) override { return put(v); }
  bool binary(binary_t&) override { return false; }
  bool start_object(size_t) override { return open(Json::object()); }
  bool start_array(size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& k) override {
    Level& top = stack_.back();
    if (top.value->contains(k)) {
      problem = fmt::format("the key '{}' stands here twice", excerpt(k));
      return false;
    }
    top.key = k;
    key_line_ = counter_.line;
    return true;
  }
  bool parse_error(size_t, const std::string&, const nlohmann::detail::exception& e) override {
    const std::string what = e.what();
    const size_t colon = what.find(": ");  // drop "[json.exception…] parse error at line …"
    // It quotes the whole token that it stumbled over.
    problem =
        "not JSON: " + excerpt(colon == std::string::npos ? what : what.substr(colon + 2), 2 * kExcerpt);
    return false;
  }

 private:
  struct Level {
    Json* value;
    std::string pointer, key;
  };

  Json* place(Json v) {
    if (stack_.empty()) {
      record("", counter_.line);
      root = std::move(v);
      return &root;
    }
    Level& top = stack_.back();
    if (top.value->is_array()) {
      if (lines_) record(fmt::format("{}/{}", top.pointer, top.value->size()), counter_.line);
      top.value->push_back(std::move(v));
      return &top.value->back();
    }
    if (lines_) record(top.pointer + "/" + pointer_token(top.key), key_line_);
    return &((*top.value)[top.key] = std::move(v));
  }
  void record(const std::string& pointer, int line) {
    if (!lines_) return;
    pointer_ = pointer;
    (*lines_)[pointer_] = line;
  }
  bool put(Json v) {
    place(std::move(v));
    return true;
  }
  bool open(Json v) {
    if (stack_.size() >= 64) {
      problem = "nested deeper than 64 levels";
      return false;
    }
    Json* placed = place(std::move(v));
    stack_.push_back({placed, pointer_, ""});
    return true;
  }
  bool close() {
    stack_.pop_back();
    return true;
  }

  const LineCounter& counter_;
  Lines* lines_;
  std::vector<Level> stack_;
  std::string pointer_;
  int key_line_ = 1;
};

bool read(std::string_view text, LineCounter* counter, Builder* builder) {
  const CountingIterator begin{text.data(), counter}, end{text.data() + text.size(), counter};
  return Json::sax_parse(begin, end, builder, nlohmann::json::input_format_t::json, true, true);
}

}  // namespace

std::string pointer_token(std::string_view key) {
  std::string out;
  for (const char c : key) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return out;
}

JsonDocument JsonDocument::load(const std::filesystem::path& path, ErrorKind kind) {
  std::string text;
  try {
    text = read_text(path);
  } catch (const Error& e) {
    throw Error(kind, e.what());
  }
  return of(std::move(text), path.string(), kind);
}

JsonDocument JsonDocument::parse(std::string_view text, std::string name, ErrorKind kind) {
  return of(std::string(text), std::move(name), kind);
}

JsonDocument JsonDocument::of(std::string text, std::string name, ErrorKind kind) {
  JsonDocument doc;
  doc.name_ = std::move(name);
  doc.kind_ = kind;
  LineCounter counter;
  Builder builder(counter, nullptr);
  if (!read(text, &counter, &builder))
    throw fail(kind, "{}:{}: {}", doc.name_, counter.line, builder.problem);
  doc.root_ = std::move(builder.root);
  doc.text_ = std::move(text);
  return doc;
}

JsonDocument JsonDocument::patched(const Json& patch) const {
  JsonDocument out = *this;
  out.root_.merge_patch(patch);
  return out;
}

int JsonDocument::line(std::string pointer) const {
  if (lines_.empty()) {
    LineCounter counter;
    Builder builder(counter, &lines_);
    read(text_, &counter, &builder);
  }
  for (;;) {
    if (const auto it = lines_.find(pointer); it != lines_.end()) return it->second;
    const size_t slash = pointer.rfind('/');
    if (slash == std::string::npos) return 1;
    pointer.resize(slash);
  }
}

Error JsonDocument::error(const std::string& pointer, const std::string& message) const {
  const std::string where = pointer.empty() ? "" : fmt::format("'{}' ", excerpt(pointer.substr(1)));
  return fail(kind_, "{}:{}: {}{}", name_, line(pointer), where, excerpt(message, kLongestMessage / 2));
}

}  // namespace vsglbench
