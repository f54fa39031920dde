// Whether a device may fuse or regroup a kernel's arithmetic: as its `precise` says, or for tests never or
// wherever it likes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vsglbench {

// as_written  operations that GLSL's `precise` marks are evaluated one by one; a driver may fuse any other
// never       every arithmetic operation is marked so (SPIR-V's NoContraction on all)
// always      none is marked: every `precise` is ignored, and a driver may fuse what it likes
enum class Contraction { as_written, never, always };

// $VSGLBENCH_CONTRACTION: "never", "always"; absent or anything else: as_written.
Contraction contraction_asked();

// Changes the decorations of a module.
void set_contraction(Contraction contraction, std::vector<uint32_t>* spirv);

}  // namespace vsglbench
