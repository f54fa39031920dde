#include "gpu/contraction.h"

#include <gtest/gtest.h>

using namespace vsglbench;

namespace {

// Header, a decoration of %9, NoContraction of %7, %7 = FAdd, %8 = IAdd.
const std::vector<uint32_t> kModule = {0x07230203,     0x10600, 0,  10, 0,   //
                                       4u << 16 | 71,  9,       33, 0,       // Binding 0
                                       3u << 16 | 71,  7,       42,          //
                                       5u << 16 | 129, 1,       7,  2,  3,   //
                                       5u << 16 | 128, 1,       8,  2,  3,   //
                                       5u << 16 | 133, 1,       6,  2,  3};  // FMul

size_t decorations(const std::vector<uint32_t>& spirv) {
  size_t n = 0;
  for (size_t i = 5; i < spirv.size(); i += spirv[i] >> 16)
    n += spirv[i] == (3u << 16 | 71) && spirv[i + 2] == 42;
  return n;
}

}  // namespace

TEST(SetContraction, DecoratesAllArithmeticOrNone) {
  auto as_written = kModule, never = kModule, always = kModule;
  set_contraction(Contraction::as_written, &as_written);
  set_contraction(Contraction::never, &never);
  set_contraction(Contraction::always, &always);
  EXPECT_EQ(as_written, kModule);
  EXPECT_EQ(decorations(never), 2u);
  EXPECT_EQ(never.size(), kModule.size() + 3);
  EXPECT_EQ(decorations(always), 0u);
  EXPECT_EQ(always.size(), kModule.size() - 3);
}
