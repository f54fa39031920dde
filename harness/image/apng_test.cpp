#include "image/apng.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <fstream>
#include <random>

#include "base/error.h"
#include "base/file.h"
#include "image/png_chunks.h"

namespace fs = std::filesystem;
using namespace vsglbench;

namespace {

class Apng : public testing::Test {
 protected:
  fs::path dir_ = fs::temp_directory_path() / ("vsglbench_apng_test_" + std::to_string(::getpid()));
  void SetUp() override { fs::create_directories(dir_); }
  void TearDown() override { fs::remove_all(dir_); }
};

// The format again, from its specification and by hand.
struct Chunk {
  std::string type;
  std::vector<uint8_t> data;
};

uint32_t number(const std::vector<uint8_t>& bytes, size_t at, size_t count = 4) {
  uint32_t value = 0;
  for (size_t i = 0; i < count; ++i) value = 256 * value + bytes.at(at + i);
  return value;
}

// Bit by bit: polynomial 0xEDB88320, begun and ended with all ones (PNG third edition, D).
uint32_t slow_crc(const std::vector<uint8_t>& bytes, size_t from, size_t to) {
  uint32_t crc = 0xFFFFFFFF;
  for (size_t i = from; i < to; ++i) {
    crc ^= bytes.at(i);
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? 0xEDB88320 ^ crc >> 1 : crc >> 1;
  }
  return ~crc;
}

std::vector<Chunk> parse(const fs::path& path) {
  const std::vector<uint8_t> file = read_bytes(path);
  const std::vector<uint8_t> signature = {137, 80, 78, 71, 13, 10, 26, 10};
  EXPECT_TRUE(std::equal(signature.begin(), signature.end(), file.begin()));
  std::vector<Chunk> chunks;
  for (size_t at = 8; at < file.size();) {
    const uint32_t length = number(file, at);
    Chunk chunk{std::string(file.begin() + at + 4, file.begin() + at + 8),
                std::vector<uint8_t>(file.begin() + at + 8, file.begin() + at + 8 + length)};
    EXPECT_EQ(number(file, at + 8 + length), slow_crc(file, at + 4, at + 8 + length)) << chunk.type;
    at += 12 + length;
    chunks.push_back(std::move(chunk));
  }
  return chunks;
}

// The fifth filter (PNG third edition, 9.4).
int nearest_to_plane(int a, int b, int c) {
  const int p = a + b - c, pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
  if (pa <= pb && pa <= pc) return a;
  return pb <= pc ? b : c;
}

// The pixels of a zlib stream, by the five filters.
std::vector<uint8_t> decode(const std::vector<uint8_t>& stream, uint32_t w, uint32_t h, uint32_t channels) {
  const size_t row = size_t(w) * channels;
  std::vector<uint8_t> raw((row + 1) * h), out(row * h);
  uLongf size = raw.size();
  EXPECT_EQ(uncompress(raw.data(), &size, stream.data(), stream.size()), Z_OK);
  EXPECT_EQ(size, raw.size());
  for (size_t y = 0; y < h; ++y) {
    const int filter = raw[y * (row + 1)];
    for (size_t i = 0; i < row; ++i) {
      const int a = i < channels ? 0 : out[y * row + i - channels];
      const int b = y == 0 ? 0 : out[(y - 1) * row + i];
      const int c = i < channels || y == 0 ? 0 : out[(y - 1) * row + i - channels];
      const int predicted[5] = {0, a, b, (a + b) / 2, nearest_to_plane(a, b, c)};
      EXPECT_LT(filter, 5);
      out[y * row + i] = static_cast<uint8_t>(raw[y * (row + 1) + 1 + i] + predicted[filter % 5]);
    }
  }
  return out;
}

std::vector<Bitmap> random_frames(uint32_t w, uint32_t h, uint32_t channels, size_t count) {
  std::mt19937 random(w + 100 * h);
  std::vector<Bitmap> frames;
  for (size_t i = 0; i < count; ++i) {
    frames.emplace_back(w, h, channels);
    uint8_t value = 0;  // noise in some frames, slopes in others, so that several filters are chosen
    for (auto& b : frames.back().bytes) b = i % 2 ? value += 3 : static_cast<uint8_t>(random());
  }
  return frames;
}

void write(const fs::path& path, const std::vector<Bitmap>& frames, double rate = 24) {
  write_apng(path, static_cast<uint32_t>(frames.size()), rate, [&](uint32_t i) { return frames.at(i); });
}

}  // namespace

TEST_F(Apng, EveryFrameIsThereInOrder) {
  const std::tuple<uint32_t, uint32_t, uint32_t, size_t> cases[] = {
      {1, 1, 3, 1}, {7, 3, 4, 2}, {300, 200, 3, 5}, {64, 64, 3, 64}};
  for (const auto& [w, h, channels, count] : cases) {
    const auto frames = random_frames(w, h, channels, count);
    write(dir_ / "a.png", frames);
    const std::vector<Chunk> chunks = parse(dir_ / "a.png");
    ASSERT_EQ(chunks.front().type, "IHDR");
    EXPECT_EQ(number(chunks.front().data, 0), w);
    EXPECT_EQ(number(chunks.front().data, 4), h);
    EXPECT_EQ(number(chunks.front().data, 8, 1), 8u) << "bits a channel";
    EXPECT_EQ(number(chunks.front().data, 9, 1), channels == 4 ? 6u : 2u) << "colour type";
    EXPECT_EQ(number(chunks.front().data, 12, 1), 0u) << "interlace";
    EXPECT_EQ(chunks.back().type, "IEND");
    uint32_t sequence = 0, controls = 0, ends = 0;
    std::vector<std::vector<uint8_t>> streams;
    for (const Chunk& c : chunks) {
      ends += c.type == "IEND";
      if (c.type == "acTL") {
        EXPECT_EQ(streams.size(), 0u) << "acTL stands before IDAT";
        EXPECT_EQ(controls++, 0u) << "and once";
        EXPECT_EQ(number(c.data, 0), count);
        EXPECT_EQ(number(c.data, 4), 0u) << "for ever";
        EXPECT_EQ(c.data.size(), 8u);
      } else if (c.type == "fcTL") {
        EXPECT_EQ(number(c.data, 0), sequence++);
        EXPECT_EQ(number(c.data, 4), w);
        EXPECT_EQ(number(c.data, 8), h);
        EXPECT_EQ(number(c.data, 12), 0u);
        EXPECT_EQ(number(c.data, 16), 0u);
        EXPECT_EQ(number(c.data, 20, 2) * 24, number(c.data, 22, 2)) << "a 24th of a second";
        EXPECT_EQ(number(c.data, 24, 2), 0u) << "dispose NONE, blend SOURCE";
        EXPECT_EQ(c.data.size(), 26u);
        streams.emplace_back();
      } else if (c.type == "IDAT") {
        ASSERT_EQ(streams.size(), 1u) << "the first frame alone is IDAT";
        streams.back().insert(streams.back().end(), c.data.begin(), c.data.end());
      } else if (c.type == "fdAT") {
        ASSERT_GT(streams.size(), 1u);
        EXPECT_EQ(number(c.data, 0), sequence++);
        streams.back().insert(streams.back().end(), c.data.begin() + 4, c.data.end());
      }
    }
    EXPECT_EQ(controls, 1u);
    EXPECT_EQ(ends, 1u);
    ASSERT_EQ(streams.size(), count);
    for (size_t i = 0; i < count; ++i)
      EXPECT_EQ(decode(streams[i], w, h, channels), frames[i].bytes) << "frame " << i;
  }
}

TEST_F(Apng, IsAnOrdinaryPictureOfTheFirstFrame) {
  const auto frames = random_frames(31, 17, 3, 3);
  write(dir_ / "a.png", frames);
  EXPECT_EQ(read_png(dir_ / "a.png").bytes, frames[0].bytes);
}

TEST_F(Apng, RatesAreKeptToAHundredth) {
  const auto frames = random_frames(2, 2, 3, 2);
  for (const double rate : {0.01, 1.0, 12.5, 23.98, 60.0, 655.0}) {
    write(dir_ / "a.png", frames, rate);
    for (const Chunk& c : parse(dir_ / "a.png")) {
      if (c.type != "fcTL") continue;
      EXPECT_NEAR(double(number(c.data, 22, 2)) / number(c.data, 20, 2), rate, 1e-9);
    }
  }
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double rate : {0.0, -1.0, infinite, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(write(dir_ / "b.png", frames, rate), Error) << rate;
}

TEST_F(Apng, ARateThatTheFormatCantHoldIsClamped) {
  const auto frames = random_frames(2, 2, 3, 2);
  const std::pair<double, double> rates[] = {{0.001, 0.001}, {656, 656},          {1e4, 1e4},
                                             {1e6, 65535},   {1e-6, 1 / 65535.0}, {1e-300, 1 / 65535.0}};
  for (const auto& [rate, shown] : rates) {
    write(dir_ / "a.png", frames, rate);
    for (const Chunk& c : parse(dir_ / "a.png")) {
      if (c.type != "fcTL") continue;
      EXPECT_NEAR(double(number(c.data, 22, 2)) / number(c.data, 20, 2) / shown, 1, 1e-9) << rate;
    }
  }
}

TEST_F(Apng, FramesAreAskedForOnceInOrder) {
  std::vector<uint32_t> asked;
  write_apng(dir_ / "a.png", 4, 10, [&](uint32_t i) {
    asked.push_back(i);
    return Bitmap(3, 2);
  });
  EXPECT_EQ(asked, (std::vector<uint32_t>{0, 1, 2, 3}));
}

TEST_F(Apng, LeavesNothingHalfWritten) {
  const auto refused = [&](const auto& frame, ErrorKind kind) {
    try {
      write_apng(dir_ / "a.png", 3, 10, frame);
      ADD_FAILURE() << "no error";
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), kind) << e.what();
    }
    EXPECT_TRUE(fs::is_empty(dir_));
  };
  refused([](uint32_t i) { return Bitmap(3, i == 2 ? 3 : 2); }, ErrorKind::output);
  refused([](uint32_t i) { return Bitmap(3, 2, i == 1 ? 4 : 3); }, ErrorKind::output);
  refused([](uint32_t) { return Bitmap(); }, ErrorKind::output);
  // What the frame itself can't do stays what it is.
  refused(
      [](uint32_t i) -> Bitmap {
        if (i == 1) throw fail(ErrorKind::case_failed, "no such frame");
        return Bitmap(3, 2);
      },
      ErrorKind::case_failed);
  EXPECT_THROW(write_apng(dir_ / "a.png", 0, 10, [](uint32_t) { return Bitmap(3, 2); }), Error);
  EXPECT_THROW(write_apng(dir_ / "b" / "..", 1, 10, [](uint32_t) { return Bitmap(3, 2); }), Error);
}

TEST(PngChunks, AreCheckedAsTheyAreRead) {
  const std::string file = encode_png(Bitmap(5, 4));
  EXPECT_EQ(png_chunks(file).front().type, "IHDR");
  EXPECT_EQ(png_chunks(file).back().type, "IEND");
  EXPECT_THROW(png_chunks(""), std::logic_error);
  EXPECT_THROW(png_chunks(file.substr(1)), std::logic_error);
  EXPECT_THROW(png_chunks(std::string_view(file).substr(0, file.size() - 1)), std::logic_error);
  EXPECT_THROW(png_chunks(std::string_view(file).substr(0, 20)), std::logic_error);
  EXPECT_EQ(png_chunk("IEND", ""), std::string("\0\0\0\0IEND\xAE\x42\x60\x82", 12));
}
