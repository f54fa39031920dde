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

TEST(Printable, TextStaysAsItIs) {
  const std::string text = "Σ light power ≤ 1 … “cornell” — 480×272, é";
  EXPECT_EQ(printable(text), text);
  EXPECT_EQ(printable("cut short \xc2"), "cut short \xc2");
}

}  // namespace
}  // namespace vsglbench
