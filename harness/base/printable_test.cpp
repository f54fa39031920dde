#include "base/printable.h"

#include <gtest/gtest.h>

namespace vsglbench {
namespace {

TEST(Printable, NothingSteersTheTerminal) {
  EXPECT_EQ(printable("\x1b[31mred\r\n\t\x7f"), " [31mred    ");
  EXPECT_EQ(printable("a\xc2\x9b"
                      "31mb"),
            "a 31mb");  // CSI of the second set
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b\xe2\x81\xa6"),
            "a b ");  // from right to left; isolate
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a b");
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

}  // namespace
}  // namespace vsglbench
