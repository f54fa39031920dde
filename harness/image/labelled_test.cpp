#include "image/labelled.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/file.h"
#include "image/exr.h"

namespace vsglbench {
namespace {

const Labels kLabels = {{"case", "cornell/mfis/N=256,rsm=256,vis=exact"}, {"note", "480×272"}, {"seed", "0"}};

std::filesystem::path temporary(const char* name) {
  return std::filesystem::temp_directory_path() / (std::to_string(::getpid()) + name);
}

TEST(Labelled, AnExrKeepsItsLabelsAndPixels) {
  const auto path = temporary("_labelled.exr");
  Image image(2, 1);
  image.pixels = {{1, 2, 3}, {4, 5, 6}};
  write_exr(path, image, {1, 0}, kLabels);
  const ExrLayers read = read_exr_layers(path);
  std::filesystem::remove(path);
  EXPECT_EQ(read.colors.at("").pixels, image.pixels);
  EXPECT_EQ(read.scalars.at("A"), (std::vector<float>{1, 0}));
  for (const auto& [name, text] : kLabels) EXPECT_EQ(read.attributes.at(name), text);
}

TEST(Labelled, APngKeepsItsLabelsAndPixels) {
  const auto path = temporary("_labelled.png");
  Bitmap bitmap(2, 1);
  bitmap.bytes = {1, 2, 3, 4, 5, 6};
  write_png(path, bitmap, kLabels);
  const Bitmap read = read_png(path);  // another library checks every chunk's CRC
  const std::string bytes = read_text(path);
  std::filesystem::remove(path);
  EXPECT_EQ(read.bytes, bitmap.bytes);
  EXPECT_EQ(png_labels(bytes), kLabels);
  EXPECT_NE(bytes.find("tEXtcase"), std::string::npos);
  EXPECT_NE(bytes.find("iTXtnote"), std::string::npos) << "tEXt is of Latin-1";
  EXPECT_EQ(png_labels(encode_png(bitmap)), Labels());
  EXPECT_THROW(with_labels(encode_png(bitmap), {{"", "x"}}), std::logic_error);
  EXPECT_THROW(with_labels(encode_png(bitmap), {{std::string(80, 'n'), "x"}}), std::logic_error);
}

}  // namespace
}  // namespace vsglbench
