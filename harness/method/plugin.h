// What a method's shared library exports, once, at the end of its .cpp:
//
//   VSGLBENCH_METHOD(MethodInfo{.summary = ..., .source = ..., .parameters = {...}, .create = ...})
#pragma once

#include "method/method.h"

namespace vsglbench {

// Raised with every change to what a method and the host share (method/, gpu/, shaders/types.h, base/): a
// plugin of another number is refused before anything else of it is used. plugin_test.cpp holds it to the
// sizes of the shared types.
inline constexpr uint32_t plugin_abi = 9;

struct PluginHeader {
  uint32_t abi;  // stands first in every version
  MethodInfo (*info)();
};

}  // namespace vsglbench

#define VSGLBENCH_METHOD(...)                                                                 \
  extern "C" const vsglbench::PluginHeader* vsglbench_plugin() {                              \
    using namespace vsglbench;                                                                \
    static const PluginHeader header{plugin_abi, []() -> MethodInfo { return __VA_ARGS__; }}; \
    return &header;                                                                           \
  }
