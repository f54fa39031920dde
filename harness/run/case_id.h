// What a case is called: "cornell/mfis/N=256,rsm=256,vis=exact".
#pragma once

#include <string>
#include <vector>

#include "run/sweep.h"

namespace vsglbench {

// One value that an id may say, in the order of the id.
struct Setting {
  std::string key;     // as the case's parameters have it
  std::string label;   // as ids have it
  Json value;          // as the config writes it
  bool named = false;  // said whether or not two cases differ in it
};

struct NamedCase {
  Case c;  // without scene and id
  std::vector<Setting> settings;
  size_t entry = 0;  // of the config's `methods`
};

// Sets each id, without the scene: "mfis/N=256,rsm=256,vis=exact". It says what is named, and every
// parameter in which two cases of one method differ.
void name_cases(std::vector<NamedCase>* cases);

// The same text for the same parameters, whichever way their numbers are written.
std::string fingerprint(const Case& c);

}  // namespace vsglbench
