#include "image/exr_header.h"

#include <OpenEXR/ImfBoxAttribute.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfDeepImageStateAttribute.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfEnvmapAttribute.h>
#include <OpenEXR/ImfFloatVectorAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfKeyCodeAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfPreviewImage.h>
#include <OpenEXR/ImfRationalAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfStringVectorAttribute.h>
#include <OpenEXR/ImfTileDescriptionAttribute.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <OpenEXR/ImfTimeCodeAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/error.h"
#include "base/file.h"
#include "image/exr.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

const char* const kTypesOfOneSize[] = {"box2f",
                                       "box2i",
                                       "chromaticities",
                                       "compression",
                                       "deepImageState",
                                       "double",
                                       "envmap",
                                       "float",
                                       "int",
                                       "keycode",
                                       "lineOrder",
                                       "m33d",
                                       "m33f",
                                       "m44d",
                                       "m44f",
                                       "rational",
                                       "tiledesc",
                                       "timecode",
                                       "v2d",
                                       "v2f",
                                       "v2i",
                                       "v3d",
                                       "v3f",
                                       "v3i"};

// A header with a value of each of OpenEXR's types.
Imf::Header rich_header() {
  Imf::Header header(4, 2);  // has compression, lineOrder, box2i, float, v2f and chlist
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  header.insert("a", Imf::Box2fAttribute());
  header.insert("b", Imf::ChromaticitiesAttribute());
  header.insert("c", Imf::DeepImageStateAttribute());
  header.insert("d", Imf::DoubleAttribute());
  header.insert("e", Imf::EnvmapAttribute());
  header.insert("f", Imf::FloatVectorAttribute({1, 2, 3}));
  header.insert("g", Imf::IntAttribute());
  header.insert("h", Imf::KeyCodeAttribute());
  header.insert("i", Imf::M33dAttribute());
  header.insert("j", Imf::M33fAttribute());
  header.insert("k", Imf::M44dAttribute());
  header.insert("l", Imf::M44fAttribute());
  header.insert("m", Imf::RationalAttribute());
  header.insert("n", Imf::StringAttribute("text"));
  header.insert("o", Imf::StringVectorAttribute({"one", "", "three"}));
  header.insert("p", Imf::TileDescriptionAttribute());
  header.insert("q", Imf::TimeCodeAttribute());
  header.insert("r", Imf::V2dAttribute());
  header.insert("s", Imf::V2iAttribute());
  header.insert("t", Imf::V3dAttribute());
  header.insert("u", Imf::V3fAttribute());
  header.insert("v", Imf::V3iAttribute());
  header.setPreviewImage(Imf::PreviewImage(3, 5));
  return header;
}

class ExrHeader : public testing::Test {
 protected:
  fs::path dir_ = fs::temp_directory_path() / ("vsglbench_exr_header_test_" + std::to_string(::getpid()));
  void SetUp() override { fs::create_directories(dir_); }
  void TearDown() override { fs::remove_all(dir_); }

  // A file of OpenEXR's own making, in one part or in two, whose pixels are only the table of their places.
  std::string rich_file(int parts) {
    const std::string path = dir_ / "rich.exr";
    if (parts == 1) {
      const Imf::OutputFile written(path.c_str(), rich_header());
    } else {
      std::vector<Imf::Header> headers(parts, rich_header());
      for (int i = 0; i < parts; ++i) {
        headers[i].setName("part" + std::to_string(i));
        headers[i].setType(Imf::SCANLINEIMAGE);
      }
      const Imf::MultiPartOutputFile written(path.c_str(), headers.data(), parts);
    }
    return read_text(path);
  }

  static std::string refusal(const std::string& file) {
    try {
      check_exr_headers({reinterpret_cast<const uint8_t*>(file.data()), file.size()});
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "none";
  }

  // The place of the size of the last attribute of this type.
  static size_t size_of_type(const std::string& file, const std::string& type) {
    const std::string name = '\0' + type + '\0';
    const size_t at = file.rfind(name);
    if (at == std::string::npos) throw std::runtime_error("no " + type);
    return at + name.size();
  }

  // The file with other numbers at the start of the value of an attribute.
  static std::string with_value(std::string file, const std::string& name, const std::string& type,
                                const std::vector<uint32_t>& numbers) {
    const std::string start = name + '\0' + type + '\0';
    const size_t found = file.find(start);
    if (found == std::string::npos) throw std::runtime_error("no " + name);
    const size_t at = found + start.size() + sizeof(uint32_t);
    for (size_t i = 0; i < 4 * numbers.size(); ++i)
      file[at + i] = static_cast<char>(numbers[i / 4] >> 8 * (i % 4));
    return file;
  }

  // An image of 4x2 in one tile.
  std::string tiled_file() {
    const std::string path = dir_ / "tiled.exr";
    Imf::Header header(4, 2);
    header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
    header.setTileDescription(Imf::TileDescription(256, 128));
    const std::vector<float> values = {1, 2, 3, 4, 5, 6, 7, 8};
    Imf::FrameBuffer frame;
    frame.insert("Z", Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow()));
    {
      Imf::TiledOutputFile file(path.c_str(), header);
      file.setFrameBuffer(frame);
      file.writeTile(0, 0);
    }
    return read_text(path);
  }

  // read_exr_layers() refuses it with less than 64 MiB of memory.
  void expect_refused_unread(const std::string& file, const std::string& why) {
    write_text(dir_ / "a.exr", file);
    const auto peak_kib = [] {
      rusage usage{};
      ::getrusage(RUSAGE_SELF, &usage);
      return usage.ru_maxrss;
    };
    const long before = peak_kib();
    try {
      read_exr_layers(dir_ / "a.exr");
      ADD_FAILURE() << "was read";
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
    }
    EXPECT_LT(peak_kib() - before, 64 << 10);
  }

  static std::string with_size(std::string file, const std::string& type, uint32_t bytes) {
    const size_t at = size_of_type(file, type);
    for (int i = 0; i < 4; ++i) file[at + i] = static_cast<char>(bytes >> 8 * i);
    return file;
  }
};

TEST_F(ExrHeader, WhatTheLibraryWritesIsSound) {
  EXPECT_EQ(refusal(rich_file(1)), "none");
  EXPECT_EQ(refusal(rich_file(3)), "none");
}

TEST_F(ExrHeader, ASizeThatIsNotTheTypesIsRefused) {
  for (const int parts : {1, 2}) {
    const std::string file = rich_file(parts);
    for (const std::string type : kTypesOfOneSize) {
      const auto now = static_cast<uint8_t>(file[size_of_type(file, type)]);
      for (const int other : {now - 1, now + 1}) {
        EXPECT_NE(refusal(with_size(file, type, other)).find("not those of its type '" + type + "'"),
                  std::string::npos)
            << parts << ' ' << type << ' ' << other;
      }
    }
    EXPECT_NE(refusal(with_size(file, "floatvector", 11)), "none");
    EXPECT_NE(refusal(with_size(file, "chlist", 17)), "none");
    EXPECT_NE(refusal(with_size(file, "chlist", 20)), "none");
  }
}

TEST_F(ExrHeader, ASizeBeyondTheFileIsRefused) {
  for (const int parts : {1, 2}) {
    std::string file = rich_file(parts);
    for (const char* type : {"chlist", "floatvector", "int", "preview", "string", "stringvector"}) {
      for (const uint32_t size : {100'000U, 0x7fffffffU, 0xffffffffU}) {
        EXPECT_NE(refusal(with_size(file, type, size)).find(fmt::format("states {} bytes where", size)),
                  std::string::npos)
            << parts << ' ' << type;
      }
    }
    file.replace(file.rfind(std::string("int") + '\0'), 3, "Int");
    EXPECT_EQ(refusal(file), "none") << "a type that the library does not know";
    EXPECT_NE(refusal(with_size(file, "Int", 0x7fffffffU)), "none");
  }
}

// The library made room for all 2 GiB before it found the file too short.
TEST_F(ExrHeader, ADamagedFileTakesNoMemory) {
  ExrLayers layers{4, 2, {}, {{"Z", std::vector<float>(8)}}, {{"note", "text"}}};
  write_exr(dir_ / "a.exr", layers);
  expect_refused_unread(with_size(read_text(dir_ / "a.exr"), "string", 0x7fffffffU), "bytes where");
}

TEST_F(ExrHeader, ATileMayBeLargerThanItsImage) {
  write_text(dir_ / "a.exr", tiled_file());
  const ExrLayers layers = read_exr_layers(dir_ / "a.exr");
  EXPECT_EQ(layers.width, 4u);
  EXPECT_EQ(layers.scalars.at("Z"), (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}));
}

// The library made room for a whole tile, or all lines of a block, before it read a pixel.
TEST_F(ExrHeader, HugeTilesAndBlocksTakeNoMemory) {
  for (const uint32_t side : {8192U, 0x7fffffffU, 0xffffffffU})
    expect_refused_unread(with_value(tiled_file(), "tiles", "tiledesc", {side, side}), "cannot hold tiles");
  std::string dwab = with_value(rich_file(1), "dataWindow", "box2i", {0, 0, 32767, 0});
  dwab[dwab.find(std::string("compression\0compression\0", 24)) + 28] = 9;
  expect_refused_unread(dwab, "cannot hold tiles");
}

TEST_F(ExrHeader, AnImageThatTheFileCanNotHoldIsRefused) {
  for (const int parts : {1, 2}) {
    const std::string file = rich_file(parts);
    const auto with_window = [&](const std::vector<uint32_t>& window) {
      return refusal(with_value(file, "dataWindow", "box2i", window));
    };
    EXPECT_EQ(with_window({5, 5, 104, 104}), "none");
    EXPECT_NE(with_window({0, 0, 9999, 9999}).find("cannot hold 10000x10000"), std::string::npos);
    EXPECT_NE(with_window({0, 0, 32768, 0}).find("out of range"), std::string::npos);
    EXPECT_NE(with_window({5, 0, 4, 0}).find("out of range"), std::string::npos);
    EXPECT_NE(with_window({0x80000000U, 0, 0x7fffffffU, 0}).find("out of range"), std::string::npos);
  }
}

}  // namespace
}  // namespace vsglbench
