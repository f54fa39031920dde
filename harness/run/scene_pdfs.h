// The halves and PDFs that generation alone is timed on: one set for all cases of a scene, size and key
// `pdf`.
#pragma once

#include <map>
#include <tuple>

#include "frame/frame.h"
#include "run/sweep.h"

namespace vsglbench {

// Cases are timed on the same PDFs, whoever would make which in a whole frame: what differs between two times
// is then the methods' own. What makes the PDF on the RSM is what the case's key `pdf` names
// (run/pdf_source.h); that on the G-buffer is reflectance for all. They are made with seed 0, outside any
// timing.
class ScenePdfs {
 public:
  explicit ScenePdfs(Stage& stage) : stage_(stage) {}
  // Throws Error for sizes that the device can't take, and as pdf_source() and read_pdf_image().
  const KeptPdfs& get(const Case& c);

 private:
  KeptPdfs make(const Case& c) const;
  KeptPdfs made_by(const std::string& method, const Json& parameters, FrameParameters frame) const;
  Buffer from_image(const std::string& path, uint32_t side) const;
  Stage& stage_;
  // By size, `pdf`, and whose it is where that is each method's own.
  std::map<std::tuple<uint32_t, uint32_t, uint32_t, uint32_t, std::string, std::string>, KeptPdfs> made_;
};

}  // namespace vsglbench
