#include "base/printable.h"

#include <gtest/gtest.h>

namespace vsglbench {
namespace {

TEST(Printable, NothingSteersTheTerminal) {
  EXPECT_EQ(printable("\x1b[31mred\r\n\t\x7f"), "\\x1b[31mred   \\x7f");
  EXPECT_EQ(printable("a\xc2\x9b"
                      "31mb"),
            "a\\u009b31mb");  // CSI of the second set
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b\xe2\x81\xa6"),
            "a\\u202eb\\u2066");  // from right to left; isolate
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
}

TEST(Printable, BytesThatAreNoTextAreWritten) {
  EXPECT_EQ(printable("a\x9b"
                      "31mb"),
            "a\\x9b31mb");  // CSI in a terminal of 8 bits
  EXPECT_EQ(printable("cut short \xc2"), "cut short \\xc2");
  EXPECT_EQ(printable("\xe2\x80"), "\\xe2\\x80");
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b");  // longer than it need be
  EXPECT_EQ(printable("\xe0\x82\x9b"), "\\xe0\\x82\\x9b");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // half a surrogate pair
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
  EXPECT_EQ(printable("\xff"), "\\xff");
}

TEST(Printable, TextStaysAsItIs) {
  const std::string text = "Σ light power ≤ 1 … “cornell” — 480×272, é";
  EXPECT_EQ(printable(text), text);
  EXPECT_EQ(printable("𝛼 U+1D6FC"), "𝛼 U+1D6FC");
}

TEST(Printable, AnExcerptHasHeadAndEndOfALongText) {
  EXPECT_EQ(excerpt("short"), "short");
  EXPECT_EQ(excerpt("abcdefghij", 10), "abcdefghij");
  EXPECT_EQ(excerpt("abcdefghijk", 10), "abcdefg…jk");
  EXPECT_EQ(excerpt("äbcdefghijk", 10), "äbcdefg…jk") << "characters, not bytes";
  EXPECT_EQ(excerpt("\x1b[2J"), "\\x1b[2J");
  const std::string large = "head" + std::string(2 << 20, 'x') + "end";
  EXPECT_EQ(excerpt(large), "head" + std::string(91, 'x') + "…" + std::string(21, 'x') + "end");
  const std::string ends = excerpt(std::string(1 << 20, '\x1b'));
  EXPECT_LE(ends.size(), 122u);
  EXPECT_EQ(ends.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace vsglbench
