// The pictures of one scene: EXR and PNG of every case, error maps, references, direct light, the contact
// sheet.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "run/case_run.h"

namespace vsglbench {

// `name` as one component of a path, whatever it holds: "colonnade:cut" becomes "colonnade@cut", "cornell"
// stays; any other sign but letters, digits and "._=,+-" becomes '_', followed by a hash so that no two names
// meet.
std::string file_name(const std::string& name);

// Writes to out/images/<scene>/ and notes the paths, relative to `out`, in `results` (one for each of
// `cases`) and `scene`. Never throws: a case whose images can't be written fails with kind "output" and keeps
// its numbers; without a contact sheet or direct light there is a warning.
void write_images(const std::filesystem::path& out, std::vector<CaseRun>& cases,
                  std::vector<CaseResult>& results, SceneReport* scene);

}  // namespace vsglbench
