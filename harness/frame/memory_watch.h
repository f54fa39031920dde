// What a method leaves unwritten of its lights, and what its kernels write past the end of a buffer.
//
// arm() fills a buffer and the words behind its end with unwritten_word while the device is idle; overrun()
// looks, after the frame, whether those behind have stayed. Nothing of it is part of a timed pass. A write
// within GUARD bytes of the end is seen whatever the device's bounds checks are, since the guard is bound
// with the buffer; one before the start, or farther behind, is not.
#pragma once

#include <string>
#include <vector>

#include "gpu/buffer.h"

namespace vsglbench {

class MemoryWatch {
 public:
  // `bytes` of `buffer` are in use, the rest may be longer. `contents`: what is in use is filled too.
  void arm(const std::string& name, const Buffer& buffer, size_t bytes, bool contents);
  // "byte 0 past the end of lights.rsm (640 bytes)" of the first buffer that was written there; empty: none
  // was. Each arm() counts once.
  std::string overrun();

 private:
  struct Armed {
    std::string name;
    const Buffer* buffer;
    VkBuffer handle;  // one that has grown since is another
    size_t end, bytes;
  };
  std::vector<Armed> armed_;
};

// Which records of `words`, an array of records of `stride` words each, hold a word that nobody wrote. Words
// of `unused` may hold anything.
struct Unwritten {
  size_t first = 0, records = 0;  // records is 0 where all are written
};
Unwritten find_unwritten(const std::vector<uint32_t>& words, size_t stride,
                         const std::vector<size_t>& unused);

}  // namespace vsglbench
