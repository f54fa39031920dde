// The halves and PDFs that generation alone is timed on: one set for all cases of a scene and size.
#pragma once

#include <map>
#include <tuple>

#include "frame/frame.h"
#include "method/registry.h"

namespace vsglbench {

// Every case is timed on the same PDFs, whoever would make which in a whole frame: what differs between two
// times is then the methods' own. They are made by maker() with seed 0, outside any timing.
class ScenePdfs {
 public:
  static const MethodInfo& maker() { return find_importance_maker(LightKind::vsgl); }  // perhaps not loaded
  explicit ScenePdfs(Stage& stage) : stage_(stage) {}
  // Throws Error for sizes that the device can't take.
  const KeptPdfs& get(const FrameParameters& parameters);

 private:
  Stage& stage_;
  std::map<std::tuple<uint32_t, uint32_t, uint32_t, uint32_t>, KeptPdfs> made_;
};

}  // namespace vsglbench
