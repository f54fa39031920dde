#include <cstdlib>

#include "bad_method.h"

// Only `abi` may be read of a header of another version.
extern "C" const vsglbench::PluginHeader* vsglbench_plugin() {
  static const vsglbench::PluginHeader header{vsglbench::plugin_abi + 1,
                                              []() -> vsglbench::MethodInfo { std::abort(); }};
  return &header;
}
