#include "report/raster.h"

#include <algorithm>

namespace vsglbench {
namespace {

std::optional<double> median_of(const CaseResult& c, std::string_view pass) {
  const auto found =
      std::ranges::find_if(c.passes, [&](const PassTiming& p) { return p.pass.name() == pass; });
  if (found == c.passes.end() || found->ms.median <= 0) return std::nullopt;
  return found->ms.median;
}

bool has_few_triangles(const Report& report, const std::string& scene) {
  const Json frame = report.config.value("frame", Json::object());
  const auto found = std::ranges::find(report.scenes, scene, &SceneReport::name);
  return found != report.scenes.end() && frame.contains("width") && frame.contains("height") &&
         4 * static_cast<double>(found->triangles) <
             frame["width"].get<double>() * frame["height"].get<double>();
}

}  // namespace

std::optional<double> raster_ratio(const Report& report) {
  std::optional<double> least;
  for (const CaseResult& c : report.cases) {
    const auto drawn = median_of(c, "gbuffer"), computed = median_of(c, "generate.gbuffer.resolve");
    if (c.status != Status::ok || !drawn || !computed || !has_few_triangles(report, c.scene)) continue;
    least = std::min(least.value_or(*drawn / *computed), *drawn / *computed);
  }
  return least;
}

}  // namespace vsglbench
