// What a method gives the host, looked at before it is used. All throw Error(plugin).
#pragma once

#include "base/error.h"
#include "method/method.h"

namespace vsglbench {

// The method with these parameters, of a known kind of light.
inline std::unique_ptr<Method> make_method(const MethodInfo& info, MethodContext& context,
                                           const Json& parameters) {
  auto method = info.create(context, parameters);
  if (!method) throw fail(ErrorKind::plugin, "{}: `create` made no method", info.name);
  const LightKind kind = method->kind();
  if (!is_light_kind(kind)) {
    throw fail(ErrorKind::plugin, "{}: kind() is {}, which is no kind of light", info.name,
               static_cast<int>(kind));
  }
  return method;
}

// How many lights it makes, at least one.
inline uint32_t light_count_of(const Method& method, const std::string& name, uint32_t wanted,
                               uint64_t texels) {
  const uint32_t count = method.light_count(wanted, texels);
  if (count == 0) {
    throw fail(ErrorKind::plugin, "{}: light_count({}, {}) is 0; it must be at least 1", name, wanted,
               texels);
  }
  return count;
}

}  // namespace vsglbench
