#include "base/pattern.h"

#include <gtest/gtest.h>

#include <random>
#include <regex>  // an oracle for short texts
#include <stdexcept>
#include <string>

namespace vsglbench {
namespace {

// All patterns of the project's schemas have these parts.
const char* const kPatterns[] = {"^[A-Za-z0-9_-][A-Za-z0-9._-]*$",
                                 "^[^/]",
                                 "^([0-9a-f]{3}|unknown)$",
                                 "^[a-z0-9_-]+(\\.[a-z0-9_-]+)*$",
                                 "^[0-9]+([.][0-9]+)?$",
                                 "^(all|(ab|ba)(,(ab|ba))*)?$",
                                 "a.b",
                                 "^time:.+$",
                                 "(a|b){2,3}c",
                                 "(a*)*b",
                                 "x?y{2}$"};

TEST(Pattern, AgreesWithTheLibraryOnRandomTexts) {
  std::mt19937 random(7);
  const std::string alphabet = "ab,./-09cxyun:time";
  size_t matches = 0;
  for (const char* text : kPatterns) {
    const Pattern pattern(text);
    const std::regex oracle(text);
    for (int i = 0; i < 4000; ++i) {
      std::string s;
      for (size_t n = random() % 8; n > 0; --n) s += alphabet[random() % (i % 2 ? 6 : alphabet.size())];
      const bool expected = std::regex_search(s, oracle);
      matches += expected;
      ASSERT_EQ(pattern.search(s), expected) << text << " in '" << s << "'";
    }
  }
  EXPECT_GT(matches, 1000u);
}

TEST(Pattern, WholeWordsOfTheSchemas) {
  EXPECT_TRUE(Pattern("^([0-9a-f]{40}|unknown)$").search(std::string(40, 'a')));
  EXPECT_FALSE(Pattern("^([0-9a-f]{40}|unknown)$").search(std::string(39, 'a')));
  EXPECT_TRUE(Pattern("^(all|(ab|ba)(,(ab|ba))*)?$").search("ab,ba"));
  EXPECT_FALSE(Pattern("^(all|(ab|ba)(,(ab|ba))*)?$").search("ab,,ba"));
  EXPECT_TRUE(Pattern("").search(""));
}

TEST(Pattern, MegabytesTakeNoStackAndLittleTime) {
  const std::string text(4 << 20, 'n');
  EXPECT_TRUE(Pattern("^[A-Za-z0-9_-][A-Za-z0-9._-]*$").search(text));
  EXPECT_FALSE(Pattern("^[A-Za-z0-9_-][A-Za-z0-9._-]*$").search(text + '/'));
  EXPECT_FALSE(Pattern("^(a*)*$").search(std::string(10000, 'a') + 'b'));
}

TEST(Pattern, WhatIsNotUnderstoodIsAFaultOfTheSchema) {
  for (const char* text : {"(a", "[a", "a{", "a{2,1}", "*", "\\d", "a)", "a{99999}"})
    EXPECT_THROW(Pattern{text}, std::logic_error) << text;
}

}  // namespace
}  // namespace vsglbench
