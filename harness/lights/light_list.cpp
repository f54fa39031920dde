#include "lights/light_list.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/csv.h"

namespace vsglbench {
namespace {

// The double that prints with the fewest digits of those that round to `value`.
double shortest(float value) { return std::stod(fmt::format("{}", value)); }

Json shortest(const glm::vec3& v) { return {shortest(v.x), shortest(v.y), shortest(v.z)}; }

Json world(const glm::dvec3& origin, const glm::vec3& offset) {
  const glm::dvec3 p = origin + glm::dvec3(offset);
  return {p.x, p.y, p.z};
}

Json lobe(const glm::vec3& axis, float sharpness, const glm::vec3& amplitude) {
  return {{"axis", shortest(axis)}, {"sharpness", shortest(sharpness)}, {"amplitude", shortest(amplitude)}};
}

Json fields(const gpu::Vsgl& l, const glm::dvec3& origin) {
  Json out = {{"mean", world(origin, l.mean)},
              {"sigma", shortest(std::sqrt(l.variance))},
              {"power", shortest(l.power)}};
  if (l.level >= 0) out["level"] = shortest(l.level);
  out["diffuse"] = lobe(l.diffuse_axis, l.diffuse_sharpness, l.diffuse);
  out["specular"] = lobe(l.specular_axis, l.specular_sharpness, l.specular);
  return out;
}

Json brdf(const gpu::Vpl& l) {
  Json out = {{"diffuse", shortest(l.diffuse)},
              {"f0", shortest(l.f0)},
              {"ndf", l.ndf > 0   ? "ggx"
                      : l.ndf < 0 ? "phong"
                                  : "none"}};
  if (l.ndf > 0) out["alpha"] = shortest(l.ndf);
  if (l.ndf < 0) out["exponent"] = shortest(-l.ndf);
  return out;
}

Json fields(const gpu::Vpl& l, const glm::dvec3& origin) {
  Json out = {{"position", world(origin, l.position)},
              {"power", shortest(l.power)},
              {"flux", shortest(l.flux)},
              {"incident", shortest(l.incident)},
              {"normal", shortest(l.normal)},
              {"geometric_normal", shortest(l.geometric_normal)},
              {"brdf", brdf(l)}};
  if (l.radius > 0) out["radius"] = shortest(l.radius);
  if (l.clamp > 0) out["clamp"] = shortest(l.clamp);
  return out;
}

// What any light has: of a kind whose record has no list of its own above.
template <class Record>
Json fields(const Record& light, const glm::dvec3& origin) {
  const LightSummary s = summary_of(light);
  Json out = {{"position", world(origin, s.position)}, {"power", shortest(s.power)}};
  if (s.variance > 0) out["sigma"] = shortest(std::sqrt(s.variance));
  if (s.radius > 0) out["radius"] = shortest(s.radius);
  return out;
}

// "/diffuse/axis/0" as "diffuse.axis.0".
std::string column_of(const std::string& pointer) {
  std::string name = pointer.substr(1);
  std::replace(name.begin(), name.end(), '/', '.');
  return name;
}

}  // namespace

Json light_list(const LightSet& set, const glm::dvec3& origin) {
  Json list = Json::array();
  const auto masses = kernel_masses(set.shapes.squares, set.rsm, set.rsm, set.pdf);
  set.lights.each([&](size_t i, const auto& record) {
    if (!(record.power > 0)) return;
    Json light = {{"index", i}};
    light.update(fields(record, origin));
    if (i < set.shapes.squares.size()) {
      const glm::vec4& s = set.shapes.squares[i];
      light["footprint"] = {{"x", shortest(s.x)}, {"y", shortest(s.y)}, {"side", shortest(s.z)}};
    }
    if (i < masses.size()) light["mass"] = masses[i];
    if (i < set.edges.size()) light["edge_share"] = set.edges[i].share;
    list.push_back(std::move(light));
  });
  return list;
}

std::string to_csv(const Json& list) {
  std::vector<Json> rows;
  std::vector<std::string> columns;  // of all lights, as they first appear
  for (const Json& light : list) {
    rows.push_back(light.flatten());
    for (const auto& [pointer, value] : rows.back().items()) {
      if (std::find(columns.begin(), columns.end(), pointer) == columns.end()) columns.push_back(pointer);
    }
  }
  std::vector<std::string> cells;
  for (const auto& pointer : columns) cells.push_back(column_of(pointer));
  std::string text = csv_row(cells);
  for (const Json& row : rows) {
    for (size_t i = 0; i < columns.size(); ++i) {
      const auto cell = row.find(columns[i]);
      cells[i] = cell == row.end() ? "" : cell->is_string() ? cell->get<std::string>() : cell->dump();
    }
    text += csv_row(cells);
  }
  return text;
}

}  // namespace vsglbench
