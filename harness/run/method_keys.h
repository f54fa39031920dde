// Which keys the cases of one method read.
#pragma once

#include <string>

#include "method/registry.h"
#include "run/case_keys.h"

namespace vsglbench {

// Why a key of generation alone (kGeneration) is refused in whole frames.
std::string unread_in_frames(const std::string& key);

struct MethodKeys {
  const MethodInfo& method;
  bool shades_frames;  // not generation alone

  // A plugin that was refused costs its own cases and nothing else: they are made, and fail. What parameters
  // it has is not known.
  bool usable() const { return method.refused.empty(); }
  // Whether the method has a parameter of this name, which is then read in place of a key.
  bool is_own(const std::string& name) const;
  // Whether lights made with these parameters are VPLs: always, or by what `makes_vpls` says.
  bool makes_vpls(const Json& parameters) const;
  // "is not read: …"; empty where any case reads the key.
  std::string why_unread(const CaseKey& key) const;
  bool reads(const CaseKey& key) const { return !is_own(key.name) && why_unread(key).empty(); }
};

}  // namespace vsglbench
