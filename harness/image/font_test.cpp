#include "image/font.h"

#include <gtest/gtest.h>

#include <map>

#include "base/error.h"
#include "base/file.h"
#include "image/canvas.h"

using namespace vsglbench;

TEST(Font, EveryPrintableSignHasItsOwnGlyph) {
  const Font font(16);
  std::vector<std::string> signs = {"\U0001F9FF", "±", "×", "≤", "≥", "·", "…", "²", "µ", "−", "σ", "κ"};
  for (char c = ' '; c <= '~'; ++c) signs.emplace_back(1, c);
  std::map<std::vector<uint8_t>, std::string> seen;  // the first sign is one that the font lacks
  for (const auto& sign : signs) {
    Canvas canvas(32, 32, glm::u8vec3(0));
    canvas.text({4, 4}, sign, font, {});
    const auto [it, added] = seen.emplace(canvas.bitmap().bytes, sign);
    EXPECT_TRUE(added) << sign << " looks like " << it->second;
  }
}

TEST(Font, TextIsAsWideAsItsSigns) {
  const Font font(15);
  EXPECT_EQ(font.width(""), 0);
  EXPECT_EQ(font.width("AVA To"), 2 * font.width("A") + font.width("V") + font.width(" ") + font.width("To"));
  EXPECT_NEAR(Font(30).width("abc"), 2 * font.width("abc"), 3);
}

TEST(Font, FitsAndWraps) {
  const Font font(15);
  EXPECT_EQ(font.fit("short", 500), "short");
  EXPECT_EQ(font.fit("abcdefgh", font.width("abc…")), "abc…");
  EXPECT_EQ(font.wrap("the quick brown fox", font.width("the quick ")),
            (std::vector<std::string>{"the quick", "brown fox"}));
  EXPECT_EQ(font.wrap("abcdef", font.width("abc")), (std::vector<std::string>{"abc", "def"}));
  EXPECT_EQ(font.wrap("\xE2\x89", 100).size(), 1u);  // half a sign
  for (const auto& line : font.wrap("N=256,rsm=256,vis=exact shading=vsgl16 and more words", 120))
    EXPECT_LE(font.width(line), 120) << line;
}

TEST(Font, TakesAnyBytes) {
  EXPECT_EQ(drawable("a\nb\x1B[31m"), "a b\\x1b[31m");
  EXPECT_EQ(drawable("\xFFx"), "\uFFFDx");
  EXPECT_EQ(drawable(std::string_view("a\0b", 3)), "a\\x00b");
  Canvas canvas(64, 32, glm::u8vec3(0));
  canvas.text({0, 0}, "\xFF\xC0", Font(12), {});
  canvas.text({30, 0}, "W", Font(12), {});  // cairo refuses all that follows what is no UTF-8
  const Bitmap b = canvas.bitmap();
  int most = 0;
  for (uint32_t x = 30; x < 64; ++x) most = std::max<int>(most, *b.at(x, 8));
  EXPECT_GT(most, 128);
}

// In a process of its own, whose fontconfig knows an empty folder only.
TEST(FontDeathTest, AMissingOneIsOneLine) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto file = std::filesystem::path(testing::TempDir()) / "vsglbench-no-fonts.conf";
  write_text(file, "<?xml version=\"1.0\"?><fontconfig><dir>/nowhere</dir></fontconfig>");
  const auto without_fonts = [&] {
    ::setenv("FONTCONFIG_FILE", file.c_str(), 1);
    try {
      Font font(12);
      std::exit(0);
    } catch (const Error& e) {
      std::fprintf(stderr, "%s\n", e.what());
      std::exit(2);
    }
  };
  EXPECT_EXIT(without_fonts(), testing::ExitedWithCode(2),
              "^(Fontconfig[^\n]*\n)*the font DejaVu Sans is not installed; install the package "
              "fonts-dejavu-core\n$");
}
