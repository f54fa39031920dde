// Names of what a reference says of itself.
#include "reference/reference.h"

namespace vsglbench {

std::string_view name(ReferenceEnd end) {
  constexpr std::string_view names[] = {"samples", "floor", "time_limit"};
  return names[static_cast<size_t>(end)];
}

std::string_view name(ShadingNormals normals) {
  return normals == ShadingNormals::light ? "light" : "camera";
}

std::optional<ShadingNormals> shading_normals_named(std::string_view text) {
  for (const ShadingNormals normals : {ShadingNormals::light, ShadingNormals::camera}) {
    if (name(normals) == text) return normals;
  }
  return std::nullopt;
}

}  // namespace vsglbench
