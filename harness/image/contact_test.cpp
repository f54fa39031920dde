#include "image/contact.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "base/error.h"
#include "image/error_map.h"

using namespace vsglbench;

namespace {

uint64_t lit_pixels(const Bitmap& bitmap) {
  uint64_t n = 0;
  for (size_t i = 0; i < bitmap.bytes.size(); i += 3) n += bitmap.bytes[i] > 128;
  return n;
}

// The picture of a sheet that has one page.
Bitmap contact_sheet(const ContactSheet& sheet) {
  auto pages = contact_pages(sheet);
  EXPECT_EQ(pages.size(), 1u);
  return std::move(pages.at(0));
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
    for (const Bitmap& b : contact_pages(sheet(w, h, 7))) {
      EXPECT_EQ(b.bytes.size(), size_t(3) * b.width * b.height);
      EXPECT_LE(b.width, 2048u) << w << "x" << h;
      EXPECT_GE(b.width, 640u) << w << "x" << h;
      EXPECT_LE(b.height, 4096u) << w << "x" << h;
    }
  }
}

// Noise, which PNG can't compress, so that a page fills soon.
TEST(Contact, PagesKeepWithinTheirLimitsAndHoldEveryEntryOnce) {
  std::mt19937 random(1);
  ContactSheet s = sheet(96, 64, 0);
  constexpr size_t kEntries = 11;
  for (size_t i = 0; i < kEntries; ++i) {
    Image noise(96, 64);
    for (auto& p : noise.pixels) p = glm::vec3(static_cast<float>(random() % 512) / 1024);
    noise.at(0, 0).x = std::numeric_limits<float>::quiet_NaN();  // a mark: magenta in image and error map
    s.entries.push_back({"method", "detail", noise, {}});
  }
  const PageLimits limits{2000, 250'000};
  const auto pages = contact_pages(s, limits);
  EXPECT_GT(pages.size(), 2u);
  EXPECT_LT(pages.size(), kEntries);
  uint64_t marks = 0;
  for (const Bitmap& page : pages) {
    EXPECT_LE(page.width, limits.side);
    EXPECT_LE(page.height, limits.side);
    EXPECT_LE(encode_png(page).size(), limits.bytes);
    EXPECT_EQ(count_color(page, {188, 188, 188}), 96 * 64 * 25u) << "every page shows the reference";
    marks += count_color(page, {255, 0, 255});
  }
  EXPECT_EQ(marks, kEntries * 2 * 25);  // enlarged five times
  EXPECT_EQ(page_name("contact", 0, 1), "contact");
  EXPECT_EQ(page_name("contact", 1, 3), "contact-2");
}

TEST(Contact, TilesShrinkWhereOneEntryIsTooMuch) {
  std::mt19937 random(1);
  ContactSheet s = sheet(480, 272, 1);
  for (auto& p : s.entries[0].image->pixels) p = glm::vec3(static_cast<float>(random() % 512) / 1024);
  const auto pages = contact_pages(s, {4096, 100'000});
  ASSERT_EQ(pages.size(), 1u);
  EXPECT_LE(encode_png(pages[0]).size(), 100'000u);
  EXPECT_THROW(contact_pages(s, {100, 100'000}), Error) << "a page without room for a caption";
}

// Every caption says how much of its error map is beyond the colours' range.
TEST(Contact, SaysWhatIsClipped) {
  const auto captions = [](float radiance, float range) {
    ContactSheet s = sheet(480, 272, 1);
    s.entries[0].image = Image(480, 272, glm::vec3(radiance));
    s.error_range = range;
    const Bitmap b = contact_sheet(s);
    return std::vector<uint8_t>(b.at(0, 60), b.at(0, 150));  // above the tiles
  };
  EXPECT_EQ(captions(0.25f, 1), captions(0.26f, 1));  // errors of −0.67 and −0.63
  EXPECT_NE(captions(0.25f, 0.65f), captions(0.26f, 0.65f)) << "all pixels are clipped, or none";
}

// Not so a page's height.
TEST(Contact, ALongDetailGoesOnInASecondLine) {
  ContactSheet s = sheet(480, 272, 1);
  s.entries[0].detail = "SMAPE 24.8 %   lit 21.0 %   RMSE 0.01551   bias";
  const Bitmap one = contact_sheet(s);
  s.entries[0].detail += " −19.9 %   FLIP 0.123   method 2023 ms";
  const Bitmap two = contact_sheet(s);
  EXPECT_EQ(two.height, one.height);
  EXPECT_GT(lit_pixels(two), lit_pixels(one));
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
