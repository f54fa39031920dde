#include "run/method_keys.h"

#include <algorithm>

namespace vsglbench {

std::string unread_in_frames(const std::string& key) {
  return fmt::format("is not read where whole frames are measured{}",
                     key == "pdf" ? ": there `importance` says whose lights make the PDF" : "");
}

bool MethodKeys::is_own(const std::string& name) const {
  return std::ranges::any_of(method.parameters, [&](const auto& p) { return p.name == name; });
}

bool MethodKeys::makes_vpls(const Json& parameters) const {
  if (method.makes_vpls.is_null()) return false;
  const auto& when = method.makes_vpls.items();
  return std::all_of(when.begin(), when.end(), [&](const auto& item) {
    return parameters.contains(item.key()) && parameters.at(item.key()) == item.value();
  });
}

std::string MethodKeys::why_unread(const CaseKey& key) const {
  if ((key.scope & kMethodTakesCount) && !method.takes_light_count) {
    return fmt::format(
        "is not read: {} makes {}", method.name,
        method.light_count > 0 ? fmt::format("{} lights", method.light_count) : "a light of every texel");
  }
  if ((key.scope & kMethodTakesPdf) && !method.takes_light_count)
    return fmt::format("is not read: {} draws no lights", method.name);
  if ((key.scope & kFrame) && !shades_frames) return "is not read where only generation is measured";
  if ((key.scope & kGeneration) && shades_frames) return unread_in_frames(key.name);
  if ((key.scope & kVsgl) && method.makes_vpls.is_object() && method.makes_vpls.empty())
    return fmt::format("is not read: {} makes VPLs, with exact BRDFs", method.name);
  return "";
}

}  // namespace vsglbench
