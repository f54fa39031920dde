#include "frame/memory_watch.h"

#include <gtest/gtest.h>

#include "gpu/recorder.h"
#include "method/context.h"

namespace vsglbench {
namespace {

Device& device() {
  static Device d;
  return d;
}

TEST(MemoryWatch, SeesAWriteBehindTheEndAndNoneWithin) {
  ScratchPool pool(device());
  Buffer& buffer = pool.get("b", 4000);
  const uint32_t word = 7;
  MemoryWatch watch;
  watch.arm("b", buffer, 640, true);
  EXPECT_EQ(buffer.download<uint32_t>(1)[0], unwritten_word);
  buffer.upload(&word, 4, 636);
  EXPECT_EQ(watch.overrun(), "");
  EXPECT_EQ(watch.overrun(), "");  // armed once, looked at once
  watch.arm("b", buffer, 640, false);
  EXPECT_EQ(buffer.download<uint32_t>(160)[159], word) << "contents stay";
  buffer.upload(&word, 4, 648);
  EXPECT_EQ(watch.overrun(), "byte 8 past the end of b (640 bytes)");
}

// The guard is bound with the buffer, and a fill leaves it alone.
TEST(MemoryWatch, TheGuardLiesBehindAllThatIsAskedFor) {
  ScratchPool pool(device());
  Buffer& buffer = pool.get("b", 4000);
  EXPECT_EQ(buffer.size(), 4000u);
  EXPECT_EQ(buffer.guard(), GrowingBuffer::kGuardBytes);
  MemoryWatch watch;
  watch.arm("b", buffer, 4000, false);
  Recorder recorder(device());
  recorder.begin();
  recorder.fill(buffer, 3);
  recorder.submit_and_wait();
  EXPECT_EQ(watch.overrun(), "");
  watch.arm("b", buffer, 4000, false);
  buffer.fill(3, 4, 4000 + GrowingBuffer::kGuardBytes - 4);
  EXPECT_EQ(watch.overrun(), "byte 16380 past the end of b (4000 bytes)");
}

TEST(MemoryWatch, FindsRecordsThatNobodyWroteInWholeOrInPart) {
  const uint32_t no = unwritten_word;
  EXPECT_EQ(find_unwritten({1, 2, 3, 4}, 2, {}).records, 0u);
  const Unwritten found = find_unwritten({1, 2, 3, no, no, no}, 2, {});
  EXPECT_EQ(found.records, 2u);
  EXPECT_EQ(found.first, 1u);
  EXPECT_EQ(find_unwritten({1, no, 3, no}, 2, {1}).records, 0u);
}

}  // namespace
}  // namespace vsglbench
