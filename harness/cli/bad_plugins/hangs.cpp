#include <unistd.h>

#include "bad_method.h"

VSGLBENCH_METHOD(bad_method("never comes back from a frame",
                            [](MethodContext&, const Json& parameters) -> std::unique_ptr<Method> {
                              const auto hang = [] {
                                for (;;) ::pause();
                              };
                              return std::make_unique<BadMethod>(hang, parameters);
                            }))
