#include "method/light_kind.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace vsglbench {
namespace {

const std::vector<LightKindInfo>& kinds() {
  // Words [first, first + count) of a field at `offset` bytes.
  const auto words = [](std::initializer_list<std::pair<size_t, size_t>> fields) {
    std::vector<size_t> out;
    for (const auto& [offset, count] : fields)
      for (size_t i = 0; i < count; ++i) out.push_back(offset / 4 + i);
    return out;
  };
  static const std::vector<size_t> unused =
      words({{offsetof(gpu::Vpl, unused0), 1}, {offsetof(gpu::Vpl, unused1), 1}});
  static const std::vector<size_t> vsgl_diffuse = words({{offsetof(gpu::Vsgl, diffuse), 7}});
  static const std::vector<size_t> vsgl_specular = words({{offsetof(gpu::Vsgl, specular), 7}});
  static const std::vector<size_t> vpl_diffuse = words({{offsetof(gpu::Vpl, diffuse), 4}});
  static const std::vector<size_t> vpl_specular =
      words({{offsetof(gpu::Vpl, ndf), 1}, {offsetof(gpu::Vpl, f0), 4}});
  static const std::vector<LightKindInfo> all = {{LightKind::vsgl,
                                                  "vsgl",
                                                  "Vsgl",
                                                  sizeof(gpu::Vsgl),
                                                  {},
                                                  vsgl_diffuse,
                                                  vsgl_specular,
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
                                                  vpl_diffuse,
                                                  vpl_specular,
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
                                                  vpl_diffuse,
                                                  vpl_specular,
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

std::vector<size_t> record_words(LightKind kind, unsigned lobes) {
  const LightKindInfo& info = info_of(kind);
  const auto left_out = [&](size_t word) {
    return (!(lobes & DIFFUSE_LOBE) && std::ranges::count(info.diffuse_words, word) > 0) ||
           (!(lobes & SPECULAR_LOBE) && std::ranges::count(info.specular_words, word) > 0);
  };
  std::vector<size_t> out;
  for (size_t word = 0; word < info.bytes / 4; ++word)
    if (!left_out(word)) out.push_back(word);
  return out;
}

size_t light_stride(LightKind kind, unsigned lobes) { return 4 * record_words(kind, lobes).size(); }

size_t moments_bytes(unsigned lobes) {
  const size_t floats_of_lobe = 7;
  return sizeof(float) * (4 + floats_of_lobe * static_cast<size_t>(std::popcount(lobes)));
}

}  // namespace vsglbench
