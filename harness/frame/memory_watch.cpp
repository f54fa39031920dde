#include "frame/memory_watch.h"

#include <fmt/format.h>

#include <algorithm>

#include "method/context.h"

namespace vsglbench {

void MemoryWatch::arm(const std::string& name, const Buffer& buffer, size_t bytes, bool contents) {
  const size_t end = (bytes + 3) / 4 * 4, all = (buffer.size() + buffer.guard()) / 4 * 4;
  if (end >= all) return;
  const size_t guard = std::min(GrowingBuffer::kGuardBytes, all - end);
  const size_t from = contents ? 0 : end;
  buffer.fill(unwritten_word, end + guard - from, from);
  armed_.push_back({name, &buffer, buffer.handle(), end, guard});
}

std::string MemoryWatch::overrun() {
  const std::vector<Armed> armed = std::move(armed_);
  armed_.clear();
  for (const Armed& a : armed) {
    if (a.buffer->handle() != a.handle) continue;
    std::vector<uint32_t> words(a.bytes / 4);
    a.buffer->download(words.data(), a.bytes, a.end);
    const auto written = std::ranges::find_if(words, [](uint32_t word) { return word != unwritten_word; });
    if (written == words.end()) continue;
    return fmt::format("byte {} past the end of {} ({} bytes)", 4 * (written - words.begin()), a.name, a.end);
  }
  return "";
}

Unwritten find_unwritten(const std::vector<uint32_t>& words, size_t stride,
                         const std::vector<size_t>& unused) {
  Unwritten found;
  for (size_t i = 0; i < words.size() / stride; ++i) {
    bool whole = true;
    for (size_t k = 0; k < stride; ++k)
      whole = whole && (words[i * stride + k] != unwritten_word || std::ranges::count(unused, k) > 0);
    if (whole) continue;
    if (found.records++ == 0) found.first = i;
  }
  return found;
}

}  // namespace vsglbench
