// The keys that a case has, as users read of them.
#pragma once

#include <string>

#include "run/case_keys.h"

namespace vsglbench {

// Which cases read the key: "shaded frames, VSGLs".
std::string readers_of(const CaseKey& key);

// Name, default, values, readers and help of each key, for `vsglbench list keys`.
Json list_case_keys();

// The keys' lines in configs/README.md and in harness/run/config.schema.json; ci/write-keys writes them
// there.
std::string keys_as_markdown();
std::string keys_as_schema();

}  // namespace vsglbench
