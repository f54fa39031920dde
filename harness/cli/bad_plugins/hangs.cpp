#include <unistd.h>

#include "bad_method.h"

VSGLBENCH_METHOD(bad_method("never comes back from its second frame",
                            [](MethodContext&, const Json&) -> std::unique_ptr<Method> {
                              return std::make_unique<BadMethod>([] {
                                for (;;) ::pause();
                              });
                            }))
