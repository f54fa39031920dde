// Whether a device may fuse or regroup a kernel's arithmetic: as its `precise` says, or for tests never or
// wherever it likes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vsglbench {

// as_written  what GLSL's `precise` says: those operations and no others are evaluated one by one
// never       every arithmetic operation is evaluated by itself (SPIR-V's NoContraction on all)
// always      none need be: every `precise` is ignored
enum class Contraction { as_written, never, always };

// $VSGLBENCH_CONTRACTION: "never", "always"; absent or anything else: as_written.
Contraction contraction_asked();

// Changes the decorations of a module.
void set_contraction(Contraction contraction, std::vector<uint32_t>* spirv);

}  // namespace vsglbench
