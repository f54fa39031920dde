// A device can't be lost on demand on every driver: this throws what the harness throws when one is.
#include "bad_method.h"
#include "gpu/check.h"

VSGLBENCH_METHOD(bad_method("loses the device in a frame",
                            [](MethodContext&, const Json& parameters) -> std::unique_ptr<Method> {
                              return std::make_unique<BadMethod>([] { VK_CHECK(VK_ERROR_DEVICE_LOST); },
                                                                 parameters);
                            }))
