#include "run/frame_export.h"

#include "base/error.h"
#include "run/motion_images.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

void copy_to(const fs::path& from, const fs::path& to) {
  std::error_code ec;
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, ec);
  if (ec) throw fail(ErrorKind::output, "{}: can't be written: {}", to.string(), ec.message());
}

// A folder without frames from `frames` on, which an earlier export may have left.
void make_folder(const fs::path& folder, uint64_t frames) {
  std::error_code ec;
  fs::create_directories(folder, ec);
  if (ec) throw fail(ErrorKind::output, "{}: can't be made: {}", folder.string(), ec.message());
  remove_frames_from(folder, frames);
}

}  // namespace

bool has_frames(const CaseResult& c) {
  return c.temporal && c.images.contains("frames") && c.images.contains("reference_frames");
}

ExportedFrames export_frames(const fs::path& folder, const CaseResult& c, double exposure,
                             const fs::path& out, const std::string& display) {
  if (!has_frames(c))
    throw fail(ErrorKind::usage, "{}: has no frames; run it with \"motion\" in its config", c.id);
  ExportedFrames done{.frames = c.temporal->frames, .peak = static_cast<float>(1 / exposure)};
  if (done.frames == 0) throw fail(ErrorKind::usage, "{}: has 0 frames", c.id);
  uint32_t width = 0, height = 0;
  for (const char* side : {"test", "reference"}) {
    const bool is_test = std::string(side) == "test";
    const fs::path from = folder / c.images.at(is_test ? "frames" : "reference_frames"), to = out / side;
    make_folder(to, done.frames);
    for (uint32_t frame = 0; frame < done.frames; ++frame) {
      const std::string exr = motion_frame_file(frame);
      const MotionFrame read = read_motion_frame(from, frame);
      if (is_test && frame == 0) width = read.image.width, height = read.image.height;
      if (read.image.width != width || read.image.height != height)
        throw fail(ErrorKind::output, "{}: has {}x{} pixels but the first frame {}x{}", (from / exr).string(),
                   read.image.width, read.image.height, width, height);
      done.rate = read.rate;
      const Png16Loss loss = write_png16(to / frame_file_name(frame), read.image, done.peak);
      if (is_test) done.loss = {done.loss.above + loss.above, done.loss.below + loss.below};
      copy_to(from / exr, to / exr);
    }
  }
  done.command = cvvdp_command(out / "test", out / "reference", done.rate, display);
  return done;
}

}  // namespace vsglbench
