#include <csignal>

#include "bad_method.h"

VSGLBENCH_METHOD(bad_method("crashes in its second frame",
                            [](MethodContext&, const Json&) -> std::unique_ptr<Method> {
                              return std::make_unique<BadMethod>([] {
                                std::signal(SIGSEGV, SIG_DFL);
                                std::raise(SIGSEGV);
                              });
                            }))
