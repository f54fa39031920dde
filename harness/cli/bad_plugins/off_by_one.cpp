// Writes each light one place too far.
#include "bad_method.h"

VSGLBENCH_METHOD(bad_method("writes lights[i + 1]",
                            [](MethodContext& context, const Json&) -> std::unique_ptr<Method> {
                              return std::make_unique<BadKernel>(context.kernel("off_by_one.comp"),
                                                                 dispatch_on_texels);
                            }))
