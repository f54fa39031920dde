#include "bad_method.h"

VSGLBENCH_METHOD(MethodInfo{.summary = "needs what no device has",
                            .source = "-",
                            .device_features = {"subgroup.basic", "shaderTelepathy"},
                            .create = [](MethodContext&, const Json&) -> std::unique_ptr<Method> {
                              return std::make_unique<BadMethod>([] {}, Json{{"frame", 2}});
                            }})
