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

// The keys that every case has beside its method's own, and what they are where a config is silent.
const Json& case_defaults();

// The cases of `doc`, a config that obeys its schema: scene by scene, entry by entry, the last list fastest.
// Throws doc.error() for an unknown method or key, an empty list, a value out of range, or a case that comes
// twice.
std::vector<Case> expand_cases(const JsonDocument& doc, const FrameParameters& base);

}  // namespace vsglbench
