#include "method/light_kind.h"

#include <algorithm>

namespace vsglbench {
namespace {

const std::vector<LightKindInfo>& kinds() {
  static const std::vector<size_t> unused = {offsetof(gpu::Vpl, unused0) / 4,
                                             offsetof(gpu::Vpl, unused1) / 4};
  static const std::vector<LightKindInfo> all = {{LightKind::vsgl,
                                                  "vsgl",
                                                  "Vsgl",
                                                  sizeof(gpu::Vsgl),
                                                  {},
                                                  false,
                                                  true,
                                                  {{"LIGHT_VPL", "0"}},
                                                  {},
                                                  "dots: means, disks: sigma"},
                                                 {LightKind::vpl,
                                                  "vpl",
                                                  "Vpl",
                                                  sizeof(gpu::Vpl),
                                                  unused,
                                                  true,
                                                  false,
                                                  {{"LIGHT_VPL", "1"}},
                                                  {},
                                                  "dots: lights"},
                                                 {LightKind::vsl,
                                                  "vsl",
                                                  "Vpl",
                                                  sizeof(gpu::Vpl),
                                                  unused,
                                                  true,
                                                  false,
                                                  {{"LIGHT_VPL", "1"}},
                                                  {{"LIGHT_VSL", "1"}},
                                                  "dots: lights, disks: their radius"}};
  return all;
}

}  // namespace

std::vector<LightKind> light_kinds() {
  std::vector<LightKind> out;
  for (const LightKindInfo& info : kinds()) out.push_back(info.kind);
  return out;
}

bool is_light_kind(LightKind kind) {
  return std::ranges::any_of(kinds(), [&](const LightKindInfo& info) { return info.kind == kind; });
}

const LightKindInfo& info_of(LightKind kind) {
  const auto found = std::ranges::find(kinds(), kind, &LightKindInfo::kind);
  if (found == kinds().end()) throw std::logic_error("a light of no kind");
  return *found;
}

}  // namespace vsglbench
