#include <cstdlib>

#include "bad_method.h"

// Of a header of another version only `abi` may be read.
extern "C" const vsglbench::PluginHeader* vsglbench_plugin() {
  static const vsglbench::PluginHeader header{vsglbench::plugin_abi + 1,
                                              []() -> vsglbench::MethodInfo { std::abort(); }};
  return &header;
}
