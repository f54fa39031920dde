// The cases of an experiment: every combination of the lists of a method's entry, for every scene.
#pragma once

#include <string>
#include <vector>

#include "base/json.h"
#include "frame/frame.h"

namespace vsglbench {

// One point of a sweep.
struct Case {
  std::string id;     // "cornell/mfis/N=256,rsm=256,vis=exact"
  std::string scene;  // as a config writes it, "sponza:A_author_aisle"
  std::string method;
  FrameParameters frame;
  Json method_parameters;  // resolved
  Json parameters;         // everything resolved, for the report
};

// What `run --set` said, by key.
using Overrides = Json;

// The cases of `root`, a config that obeys its schema and has taken in `overrides`: scene by scene, entry by
// entry, the last list fastest. `doc` is its file. Throws doc.error() for an unknown method or key, an empty
// list, a value out of range, or a case that comes twice.
std::vector<Case> expand_cases(const JsonDocument& doc, const Json& root, const Overrides& overrides,
                               const FrameParameters& base);

// The cases that any of `globs` matches, in their order; all where there is none. Throws Error(usage), naming
// the nearest id, for a glob that matches none; `option` is where the globs come from.
std::vector<Case> select_cases(const std::vector<Case>& cases, const std::vector<std::string>& globs,
                               const std::string& option);

}  // namespace vsglbench
