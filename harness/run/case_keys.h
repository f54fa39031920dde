// The keys that a case has beside its method's own parameters: one row a key. From it come the axes of a
// sweep, ids, resolved settings, `run --set`, and the tables of config.schema.json and configs/README.md.
// A new key is a row here, a field of FrameParameters, and its use; a way to shade VSGLs is a row of
// frame/shading.cpp, and its use in a shader.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/json.h"
#include "frame/frame.h"

namespace vsglbench {

// Which cases read a key: those for which all of these hold.
enum KeyScope : unsigned {
  kEveryCase = 0,
  kMethodTakesCount = 1,  // the method takes a number of lights
  kMethodTakesPdf = 2,    // the method draws its lights by a PDF
  kFrame = 4,             // frames are shaded; not generation alone
  kVsgl = 8,              // lights are VSGLs, not VPLs, which have exact BRDFs
  kGeneration = 16,       // generation alone is measured; not frames
};

enum class InId { always, where_it_differs };

struct CaseKey {
  std::string name;
  Json default_value;  // that of the field
  unsigned scope = kEveryCase;
  InId in_id = InId::where_it_differs;
  std::string help;    // one line
  Json schema;         // JSON Schema of one value
  std::string values;  // that schema in words: "1 … 16384"
  // Puts a value into its field. Throws Error(config) that says what is wrong with it, but not where it
  // stands.
  std::function<void(const Json& value, FrameParameters* frame)> read;
  // What neither schema nor read() can tell: whether what a value names exists. Throws likewise; null:
  // nothing to tell.
  std::function<void(const FrameParameters& frame)> look_up;
  std::function<Json(const FrameParameters& frame)> write;
  std::string name_in_id;
};

// In the order of a sweep, whose last key changes fastest, and of ids.
const std::vector<CaseKey>& case_keys();

const CaseKey* find_case_key(const std::string& name);  // null: there is none
std::vector<std::string> case_key_names();

}  // namespace vsglbench
