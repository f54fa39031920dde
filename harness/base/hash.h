// 128-bit content hashes (XXH3) for caches and references.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace vsglbench {

// Feeds bytes in order; the digest depends on every byte and on the order of the calls.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher& bytes(const void* data, size_t size);
  Hasher& text(std::string_view s);  // length first, so that ("a","bc") and ("ab","c") differ
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T> Hasher& value(T v) { return bytes(&v, sizeof v); }
  template <class T>
  requires std::is_trivially_copyable_v<T> Hasher& array(const std::vector<T>& v) {
    return value(v.size()).bytes(v.data(), v.size() * sizeof(T));
  }
  std::string hex() const;  // 32 lower-case hex digits

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vsglbench
