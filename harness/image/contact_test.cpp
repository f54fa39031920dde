#include "image/contact.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "base/error.h"
#include "image/error_map.h"
#include "image/text.h"

using namespace vsglbench;

namespace {

uint64_t lit_pixels(const Bitmap& bitmap) {
  uint64_t n = 0;
  for (size_t i = 0; i < bitmap.bytes.size(); i += 3) n += bitmap.bytes[i] > 128;
  return n;
}

Bitmap drawn(std::string_view text, uint32_t scale = 1) {
  Bitmap bitmap(text_width(text, scale) + 1, kGlyphHeight * scale);
  draw_text(bitmap, 0, 0, text, {255, 255, 255}, scale);
  return bitmap;
}

ContactSheet sheet(uint32_t w, uint32_t h, size_t entries) {
  ContactSheet s;
  s.title = "title";
  s.reference = Image(w, h, glm::vec3(0.5f));
  for (size_t i = 0; i < entries; ++i)
    s.entries.push_back({"method", "detail", Image(w, h, glm::vec3(0.25f)), {}});
  return s;
}

uint64_t count_color(const Bitmap& bitmap, glm::u8vec3 color) {
  uint64_t n = 0;
  for (size_t i = 0; i < bitmap.bytes.size(); i += 3) {
    n += bitmap.bytes[i] == color.x && bitmap.bytes[i + 1] == color.y && bitmap.bytes[i + 2] == color.z;
  }
  return n;
}

}  // namespace

TEST(Text, EveryPrintableSignHasItsOwnGlyph) {
  std::vector<std::string> signs = {"\x01", "±", "×", "≤", "≥", "·", "…", "²", "µ"};  // the first: unknown
  for (char c = ' '; c <= '~'; ++c) signs.emplace_back(1, c);
  std::map<std::string, std::string> seen;
  for (const auto& sign : signs) {
    const Bitmap picture = drawn(sign);
    const auto [it, added] = seen.emplace(std::string(picture.bytes.begin(), picture.bytes.end()), sign);
    EXPECT_TRUE(added) << sign << " looks like " << it->second;
  }
}

TEST(Text, ScalesAndClips) {
  EXPECT_EQ(text_width("abc", 2), 34u);
  EXPECT_EQ(text_width("≤", 1), 5u);
  EXPECT_EQ(text_width("", 3), 0u);
  EXPECT_EQ(lit_pixels(drawn("A", 3)), 9 * lit_pixels(drawn("A", 1)));
  Bitmap small(4, 4);
  draw_text(small, 2, 2, "W", {255, 255, 255}, 2);  // runs out of the bitmap on both sides
  EXPECT_GT(lit_pixels(small), 0u);
}

TEST(Text, FitsAndWraps) {
  EXPECT_EQ(fit_text("short", 500, 1), "short");
  EXPECT_EQ(fit_text("abcdefgh", text_width("abcde", 1), 1), "abcd…");
  const auto lines = wrap_text("the quick brown fox", text_width("the quick", 1), 1);
  EXPECT_EQ(lines, (std::vector<std::string>{"the quick", "brown fox"}));
  EXPECT_EQ(wrap_text("abcdef", text_width("abc", 1), 1), (std::vector<std::string>{"abc", "def"}));
  EXPECT_EQ(wrap_text("\xE2\x89", 100, 1).size(), 1u);  // half a sign
}

TEST(Contact, HoldsEveryTileAndItsError) {
  const Bitmap b = contact_sheet(sheet(480, 272, 3));
  EXPECT_GT(b.width, 4 * 480u);
  EXPECT_GT(b.height, 2 * 272u);
  // reference 0.5, entries 0.25: relative error −2/3 against the range 1.
  EXPECT_EQ(count_color(b, {188, 188, 188}), 480 * 272u);
  EXPECT_EQ(count_color(b, {137, 137, 137}), 3 * 480 * 272u);
  EXPECT_GE(count_color(b, diverging_color(-2.0f / 3)), 3 * 480 * 272u);
}

TEST(Contact, WrapsIntoRowsAndTakesAnySize) {
  for (const auto& [w, h] :
       {std::pair{1u, 1u}, {33u, 17u}, {128u, 128u}, {1920u, 1088u}, {1u, 300u}, {999u, 3u}}) {
    const Bitmap b = contact_sheet(sheet(w, h, 7));
    EXPECT_EQ(b.bytes.size(), size_t(3) * b.width * b.height);
    EXPECT_LE(b.width, 2048u) << w << "x" << h;
    EXPECT_GE(b.width, 640u) << w << "x" << h;
    EXPECT_LE(b.height, 9000u) << w << "x" << h;
  }
}

TEST(Contact, FailedCasesAndBadPixelsAreShown) {
  ContactSheet s = sheet(480, 272, 1);
  s.entries.push_back({"vpl", "failed: pixel (3, 4) is NaN", std::nullopt, std::nullopt});
  s.entries[0].image->at(10, 10).x = std::numeric_limits<float>::quiet_NaN();
  s.mask.assign(480 * 272, 1);
  s.mask[0] = 0;
  const Bitmap b = contact_sheet(s);
  EXPECT_EQ(count_color(b, {255, 0, 255}), 2u);  // in the image and in the error map
}

TEST(Contact, ALongDetailGoesOnInASecondLine) {
  ContactSheet s = sheet(480, 272, 1);
  const Bitmap one = contact_sheet(s);
  s.entries[0].detail = "SMAPE 24.8% lit 21.0% RMSE 0.01551 bias";  // 39 signs: as many as fit
  const Bitmap full = contact_sheet(s);
  s.entries[0].detail += " -19.9% FLIP 0.123";
  const Bitmap two = contact_sheet(s);
  s.entries[0].detail = "SMAPE 24.8%\nFLIP 0.123";
  EXPECT_LT(lit_pixels(contact_sheet(s)), lit_pixels(full));
  EXPECT_EQ(two.height, one.height);
  EXPECT_GT(lit_pixels(two), lit_pixels(full));
}

TEST(Contact, AnEntryMayHaveItsOwnReference) {
  ContactSheet s = sheet(480, 272, 1);
  s.entries[0].reference = s.entries[0].image;
  EXPECT_GE(count_color(contact_sheet(s), diverging_color(0)), 480 * 272u);
}

TEST(Contact, RefusesSizesThatDiffer) {
  ContactSheet s = sheet(480, 272, 1);
  s.entries[0].image = Image(4, 4);
  EXPECT_THROW(contact_sheet(s), Error);
  EXPECT_THROW(contact_sheet(ContactSheet()), Error);
}
