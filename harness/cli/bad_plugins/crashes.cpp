#include <csignal>

#include "bad_method.h"

VSGLBENCH_METHOD(bad_method("crashes in a frame",
                            [](MethodContext&, const Json& parameters) -> std::unique_ptr<Method> {
                              const auto crash = [] {
                                std::signal(SIGSEGV, SIG_DFL);
                                std::raise(SIGSEGV);
                              };
                              return std::make_unique<BadMethod>(crash, parameters);
                            }))
