// The pictures of a case in motion: its frames and its references' as EXR, and what is drawn from them.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "image/flicker.h"
#include "image/labelled.h"
#include "run/case_run.h"

namespace vsglbench {

// "0003.exr".
std::string motion_frame_file(uint32_t frame);
// Removes the EXRs and PNGs of frames `first` on from a folder, which need not be there. Throws
// Error(output).
void remove_frames_from(const std::filesystem::path& folder, uint64_t first);

// Frame "0003.exr" of such a folder, with its coverage and the animation's frames a second. Throws
// Error(output).
struct MotionFrame {
  Image image;
  Mask mask;
  double rate = 0;
};
MotionFrame read_motion_frame(const std::filesystem::path& folder, uint32_t frame);

class MotionImages {
 public:
  // `scene` outlives this, and is in the frame that is written.
  MotionImages(std::filesystem::path out, const Scene& scene) : out_(std::move(out)), scene_(scene) {}

  // One frame of seed 0, and of its reference. Throws Error(output).
  void write(const Case& c, uint32_t frame, const CaseRun::Look& look) const;
  void write(const Case& c, uint32_t frame, const ReferenceResult& reference) const;

  // Draws, from the frames on the disk, the animated picture of the crop that flickers most beside the
  // reference ("flicker") and the row through its middle over time ("profile"); their paths, and the frames'
  // folder ("frames") and their references' ("reference_frames"). What an earlier run left there of frames
  // that were not measured now is removed. Throws Error(output), Error(case_failed).
  std::map<std::string, std::string> draw(const Case& c, const DerivativeFlickerMeter& meter,
                                          float exposure) const;

 private:
  void write(const std::filesystem::path& folder, uint32_t frame, const Image& image, const Mask& mask,
             Labels labels) const;

  std::filesystem::path out_;
  const Scene& scene_;
};

// Where the frames of a case lie, relative to the report's folder; of its references, those of every case
// with the same size and occlusion.
std::string frames_folder(const Case& c);
std::string reference_frames_folder(const Case& c);

}  // namespace vsglbench
