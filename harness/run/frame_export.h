// Frames of a case and of its reference, as video metrics take them.
#pragma once

#include <filesystem>
#include <string>

#include "image/png16.h"
#include "report/report.h"

namespace vsglbench {

struct ExportedFrames {
  uint64_t frames = 0;
  double rate = 0;      // a second
  float peak = 0;       // W/m²/sr that the PNGs' full scale stands for
  Png16Loss loss;       // of the test's frames together
  std::string command;  // of cvvdp, that compares the two
};

// Whether a case has frames to export.
bool has_frames(const CaseResult& c);

// Writes `out`/test and `out`/reference, 0000.png and 0000.exr on: PNGs of 16 bits whose full scale is
// 1 / `exposure`, and the EXRs of the run in `folder`, linear W/m²/sr; frames of
// higher numbers, of an earlier export, are removed. `display`: a name that cvvdp knows. Throws Error(usage)
// for a case without frames, Error(output), also where they are not all of one size.
ExportedFrames export_frames(const std::filesystem::path& folder, const CaseResult& c, double exposure,
                             const std::filesystem::path& out, const std::string& display);

}  // namespace vsglbench
