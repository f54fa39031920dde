// The pictures of one scene: EXR and PNG of every case, error maps, references, direct light, the contact
// sheet's pages.
#pragma once

#include <filesystem>
#include <future>
#include <map>
#include <string>
#include <vector>

#include "reference/tracer.h"
#include "run/case_run.h"

namespace vsglbench {

// `name` as one component of a path, whatever it holds: "colonnade:cut" becomes "colonnade@cut", "cornell"
// stays; any other sign but letters, digits and "._=,+-" becomes '_', followed by a hash so that no two names
// meet.
std::string file_name(const std::string& name);

// "images/cornell": where a scene's pictures lie, below the report's folder; and how the names of a case's
// begin, "images/cornell/mfis/N=256,rsm=256,vis=exact".
std::string scene_folder(const std::string& scene);
std::string image_stem(const Case& c);

// "x.png", which lies beside every "x.exr" that a report names: the picture as it is looked at.
std::string preview_of(std::string exr);

// "SMAPE 24.8 %   lit 21 %   RMSE 0.0155", and in a second line "bias −19.9 %   FLIP 0.12   method 41.5 ms",
// or why there are no errors.
std::string figures_of(const CaseResult& c);

// The cases' order on a contact sheet, as indices: by method, then N, then as the config has them.
std::vector<size_t> sheet_order(const std::vector<CaseResult>& cases);

// What a contact sheet says of the cases of one scene: each one's method with those "KEY=VALUE" of its id
// that not all cases have, such as "mfis N=64"; and those that they all have.
struct Captions {
  std::vector<std::string> cases;
  std::string shared;  // "rsm=256 vis=exact"
};
Captions captions_of(const std::vector<CaseResult>& cases);

// Writes to out/images/<scene>/, every case as soon as it is measured: what is on the disk survives whatever
// a later case does. Nothing here throws but Error(device_lost).
class SceneImages {
 public:
  // `exposed`: another process has written images of the scene, and chosen its exposure. Notes exposure and
  // contact sheet in `scene`.
  SceneImages(std::filesystem::path out, bool exposed, SceneReport* scene);

  // By which direct light is traced; without one there is no picture of it.
  void trace_by(const Tracer* tracer) { tracer_ = tracer; }

  // Its image, error map and reference, the first time the scene's direct light, too, at an exposure of its
  // own; for a case that was looked at, whose frame and images stand until finish(). Images and error maps
  // are written by another thread. A case without an image is left alone.
  void start(CaseRun& run);
  // Waits for them and tells the case their paths, relative to `out`; where they can't be written it
  // fails in the end, with kind "output", and keeps its numbers.
  void finish(CaseRun& run);

  // The contact sheet of all cases, from what was written, as contact.png or, of several pages, contact-1.png
  // and so on; without it there is a warning. `shown`: the reference of the first case that has an image.
  void write_sheet(const std::vector<CaseResult>& cases, const ReferenceResult& shown,
                   const ReferenceInfo& info);

 private:
  void write_direct(const Frame& frame);
  std::filesystem::path out_;
  SceneReport* scene_;
  const Tracer* tracer_ = nullptr;
  bool exposed_ = false;  // the scene's exposure is chosen
  bool direct_ = false;   // written
  std::map<const CaseRun*, std::future<std::map<std::string, std::string>>> open_;
};

}  // namespace vsglbench
