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

}  // namespace

ExportedFrames export_frames(const fs::path& folder, const CaseResult& c, double exposure, const fs::path& out,
                             const std::string& display) {
  if (!c.temporal || !c.images.contains("frames") || !c.images.contains("reference_frames"))
    throw fail(ErrorKind::usage, "{}: has no frames; run it with \"motion\" in its config", c.id);
  ExportedFrames done{.frames = c.temporal->frames, .peak = static_cast<float>(1 / exposure)};
  for (const char* side : {"test", "reference"}) {
    const bool is_test = std::string(side) == "test";
    const fs::path from = folder / c.images.at(is_test ? "frames" : "reference_frames"), to = out / side;
    fs::create_directories(to);
    for (uint32_t frame = 0; frame < done.frames; ++frame) {
      const MotionFrame read = read_motion_frame(from, frame);
      done.rate = read.rate;
      const Png16Loss loss = write_png16(to / frame_file_name(frame), read.image, done.peak);
      if (is_test) done.loss = {done.loss.above + loss.above, done.loss.below + loss.below};
      const std::string exr = fmt::format("{:04}.exr", frame);
      copy_to(from / exr, to / exr);
    }
  }
  done.command = cvvdp_command(out / "test", out / "reference", done.rate, display);
  return done;
}

}  // namespace vsglbench
