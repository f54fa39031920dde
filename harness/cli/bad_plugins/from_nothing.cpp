// Lights of one watt each, whatever the texels reflect.
#include "bad_method.h"

VSGLBENCH_METHOD(bad_method("makes power from nothing",
                            [](MethodContext& context, const Json&) -> std::unique_ptr<Method> {
                              return std::make_unique<BadKernel>(context.kernel("from_nothing.comp"),
                                                                 dispatch_on_texels);
                            }))
