// libFuzzer's entry; $VSGLBENCH_FUZZ_TARGET names the target.
#include <cstdio>
#include <cstdlib>

#include "fuzz/targets.h"
#include "method/registry.h"

namespace {

const vsglbench::fuzz::Target* target = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  const char* name = std::getenv("VSGLBENCH_FUZZ_TARGET");
  for (const auto& t : vsglbench::fuzz::targets()) {
    if (name && t.name == name) target = &t;
  }
  if (!target) {
    std::fputs("VSGLBENCH_FUZZ_TARGET names no target; the known ones:", stderr);
    for (const auto& t : vsglbench::fuzz::targets()) std::fprintf(stderr, " %s", t.name.data());
    std::fputs("\n", stderr);
    std::exit(2);
  }
  vsglbench::all_methods();  // asked in a child process, once, before there is anything else
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  target->read({data, size});
  return 0;
}
