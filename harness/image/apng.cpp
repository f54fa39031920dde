#include "image/apng.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <exception>
#include <fstream>

#include "base/error.h"
#include "base/file.h"
#include "image/png_chunks.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr uint32_t kForever = 0, kKeep = 0, kReplace = 0;  // num_plays, dispose_op NONE, blend_op SOURCE
constexpr double kMostOfDelay = 65535;                     // of its numerator and denominator

// Seconds that a frame is shown.
struct Delay {
  uint32_t numerator, denominator;
};

// What comes before a frame's pixels. Control and data chunks are numbered together.
std::string frame_control(uint32_t* sequence, const Bitmap& bitmap, const Delay& delay) {
  return png_chunk("fcTL", big_endian((*sequence)++) + big_endian(bitmap.width) + big_endian(bitmap.height) +
                               big_endian(0) + big_endian(0) + big_endian(delay.numerator, 2) +
                               big_endian(delay.denominator, 2) + big_endian(kKeep, 1) +
                               big_endian(kReplace, 1));
}

// An ordinary PNG file but for its end, with the animation's chunks where they belong: before IDAT.
std::string first_frame(const Bitmap& bitmap, uint32_t frames, const Delay& delay, const Labels& labels,
                        uint32_t* sequence) {
  const std::string encoded = with_labels(encode_png(bitmap), labels);
  std::string out(kPngSignature);
  bool pixels = false;
  for (const PngChunk& chunk : png_chunks(encoded)) {
    if (chunk.type == "IEND") continue;
    if (chunk.type == "IDAT" && !pixels) {
      out += png_chunk("acTL", big_endian(frames) + big_endian(kForever));
      out += frame_control(sequence, bitmap, delay);
      pixels = true;
    }
    out += png_chunk(chunk.type, chunk.data);
  }
  return out;
}

std::string further_frame(const Bitmap& bitmap, const Delay& delay, uint32_t* sequence) {
  const std::string encoded = encode_png(bitmap);
  std::string out = frame_control(sequence, bitmap, delay);
  for (const PngChunk& chunk : png_chunks(encoded)) {
    if (chunk.type == "IDAT") out += png_chunk("fdAT", big_endian((*sequence)++) + std::string(chunk.data));
  }
  return out;
}

Delay delay_of(double frames_per_second) {
  if (!(frames_per_second > 0) || !std::isfinite(frames_per_second))
    throw fail(ErrorKind::output, "{} frames a second are no rate", frames_per_second);
  const auto whole = [](double v) { return static_cast<uint32_t>(std::min(std::round(v), kMostOfDelay)); };
  if (frames_per_second < 0.01) return {whole(1 / frames_per_second), 1};
  if (100 * frames_per_second <= kMostOfDelay) return {100, whole(100 * frames_per_second)};
  return {1, whole(frames_per_second)};
}

// All chunks of the animation into an open file.
void write_frames(std::ostream& out, uint32_t frames, const Delay& delay, const Labels& labels,
                  const std::function<Bitmap(uint32_t)>& frame) {
  uint32_t sequence = 0, width = 0, height = 0, channels = 0;
  for (uint32_t i = 0; i < frames; ++i) {
    const Bitmap bitmap = frame(i);
    if (i == 0) width = bitmap.width, height = bitmap.height, channels = bitmap.channels;
    if (bitmap.width != width || bitmap.height != height || bitmap.channels != channels) {
      throw fail(ErrorKind::output, "frame {} has {}x{} pixels of {} channels but the first one {}x{} of {}",
                 i, bitmap.width, bitmap.height, bitmap.channels, width, height, channels);
    }
    out << (i == 0 ? first_frame(bitmap, frames, delay, labels, &sequence)
                   : further_frame(bitmap, delay, &sequence));
  }
  out << png_chunk("IEND", "");
}

}  // namespace

void write_apng(const fs::path& path, uint32_t frames, double frames_per_second,
                const std::function<Bitmap(uint32_t)>& frame, const Labels& labels) {
  if (frames == 0) throw fail(ErrorKind::output, "{}: an animation without frames", path.string());
  const Delay delay = delay_of(frames_per_second);
  std::exception_ptr no_frame;
  const auto asked = [&](uint32_t i) {
    try {
      return frame(i);
    } catch (...) {
      no_frame = std::current_exception();
      throw;
    }
  };
  try {
    write_atomically(path, [&](const fs::path& temporary) {
      std::ofstream out(temporary, std::ios::binary);
      write_frames(out, frames, delay, labels, asked);
      out.flush();
      if (!out) throw std::runtime_error(std::strerror(errno));
    });
  } catch (...) {
    if (no_frame) std::rethrow_exception(no_frame);
    throw;
  }
}

}  // namespace vsglbench
