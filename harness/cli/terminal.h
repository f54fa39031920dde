// How wide what is printed may be.
#pragma once

#include <cstddef>

namespace vsglbench {

// $COLUMNS where it is a number above 0, else the width of the terminal that standard output is; 0: no limit,
// as where it is a pipe or a file.
size_t terminal_width();

}  // namespace vsglbench
