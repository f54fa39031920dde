#include "operation/approximations.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "operation/approximation_cases.h"
#include "operation/sg_evaluation.h"

namespace vsglbench {
namespace {

using glm::dvec3;
using namespace approximation;

double sharpness_of(double ndf) { return ndf > 0 ? 2 / (ndf * ndf) : -ndf; }
std::string ndf_name(float ndf) {
  return ndf > 0 ? fmt::format("GGX {}", ndf) : fmt::format("Phong {}", -ndf);
}

// One case: the pair at each angle.
struct PairRow {
  std::string name;
  std::array<ShadingPair, kViewAngles> pairs;
};

using Exact = std::function<double(const exact::Surface&, const ShadingPair&)>;

std::vector<ErrorRow> errors_of(ShadingProbe& probe, const std::vector<PairRow>& rows, ProbeMode mode,
                                const ShaderDefines& defines, const Exact& exact_value) {
  std::vector<ShadingPair> pairs;
  for (const PairRow& row : rows) pairs.insert(pairs.end(), row.pairs.begin(), row.pairs.end());
  const std::vector<glm::vec4> values = probe.shade(pairs, mode, defines);
  std::vector<ErrorRow> errors;
  for (size_t i = 0; i < rows.size(); ++i) {
    ErrorRow row{rows[i].name};
    for (size_t k = 0; k < kViewAngles; ++k) {
      const ShadingPair& pair = rows[i].pairs[k];
      row.error[k] = values[i * kViewAngles + k].x / exact_value(exact::surface_of(pair.surface), pair) - 1;
    }
    errors.push_back(row);
  }
  return errors;
}

std::vector<ErrorRow> receiver_errors(Device& device) {
  const std::vector<float> rows = sg_receiver::table_rows();
  const size_t columns = sg_receiver::columns().size(), places = std::size(sg_receiver::kPlaces);
  const SgAnswers answers = SgEvaluator(device, {SgFunction::receiver}).evaluate(rows);
  std::vector<ErrorRow> errors;
  for (size_t block = 0; block < answers.exact.size(); block += kViewAngles * places) {
    const float* first = &rows[block * columns];
    for (size_t place = 0; place < places; ++place) {
      ErrorRow row{fmt::format("{} F0 {} under {:.4g} {}", ndf_name(first[0]), first[1], first[5],
                               sg_receiver::kPlaces[place])};
      for (size_t k = 0; k < kViewAngles; ++k) {
        const size_t i = block + k * places + place;
        row.error[k] = answers.values[i] / answers.exact[i] - 1;
      }
      errors.push_back(row);
    }
  }
  return errors;
}

// 8 × 8 texels of 1 mm, lit from 100 m away in the direction `incident`. Their normals differ by `spread` rad
// a standard deviation, or not at all.
oracle::Half texel_set(const Material& material, const dvec3& incident, double spread) {
  constexpr uint32_t kSize = 8;
  oracle::Half half;
  half.emitter = {.position = glm::vec3(100.0 * incident),
                  .perspective = 1,
                  .forward = glm::vec3(-incident),
                  .width = kSize,
                  .right = glm::vec3(across()),
                  .height = kSize,
                  .up = glm::vec3(glm::cross(across(), -incident)),
                  .footprint_cosine = 0.1f,
                  .extent = {4e-3f, 4e-3f},
                  .power = glm::vec3(1)};
  for (uint32_t i = 0; i < kSize * kSize; ++i) {
    const uint32_t column = i % kSize, row = i / kSize;
    const dvec3 place(column / 3.5 - 1, row / 3.5 - 1, 0);  // uniform in [-1,1]², of deviation 0.65
    oracle::Texel t;
    t.position = glm::vec3(4e-3 * (place.x * away_at(0.0) + place.y * across()));
    t.normal = t.geometric_normal =
        glm::normalize(normal() + spread / 0.65 * (place.x * away_at(0.0) + place.y * across()));
    t.diffuse = glm::vec3(material.albedo);
    t.f0 = glm::vec3(material.f0);
    t.ndf = material.ndf;
    half.texels.push_back(t);
    half.pdf.push_back(1);
  }
  return half;
}

// The texels' own radiance at a surface.
double exact_of_texels(const oracle::Half& half, const exact::Surface& surface) {
  double sum = 0;
  for (uint32_t i = 0; i < half.texels.size(); ++i) {
    const oracle::Texel& t = half.texels[i];
    gpu::Vpl v = record_of({"", t.diffuse.x, t.f0.x, t.ndf}, t.normal,
                           glm::normalize(half.emitter.position - t.position));
    v.position = t.position;
    v.flux = glm::vec3(oracle::texel_flux(half.emitter, i % half.emitter.width, i / half.emitter.width));
    sum += exact::shade_vpl(surface, v).x;
  }
  return sum;
}

// A white Lambert surface 100 m away that looks at the texels, in this direction from them.
ShadingPair far_receiver(const dvec3& direction, const gpu::Vsgl& light) {
  ShadingPair pair{.surface = record_of({"", 1, 0, 1}, -direction, -direction), .light = light};
  pair.surface.position = glm::vec3(100.0 * direction);
  return pair;
}

std::vector<ErrorRow> emitter_errors(ShadingProbe& probe) {
  std::vector<PairRow> rows;
  std::vector<std::array<double, kViewAngles>> exact_values;
  const auto add = [&](const std::string& name, const Material& material, double spread,
                       const auto& direction_at) {
    PairRow row{name};
    auto& exact_row = exact_values.emplace_back();
    for (size_t k = 0; k < kViewAngles; ++k) {
      const double angle = radians(sg_receiver::kViews[k]);
      const oracle::Half half = texel_set(material, view_at(angle), spread);
      row.pairs[k] = far_receiver(direction_at(angle), probe.light_of(half));
      exact_row[k] = exact_of_texels(half, exact::surface_of(row.pairs[k].surface));
    }
    rows.push_back(row);
  };
  for (const float ndf : {-30.0f, -300.0f, -1023.0f, -65535.0f, 0.05f, 0.1f, 0.3f, 1.0f}) {
    const double width = std::min(2 / std::sqrt(sharpness_of(ndf)), radians(30));
    const Material material{"", 0, 1, ndf};
    for (const double spread : {0.0, width / 2}) {
      const std::string name = ndf_name(ndf) + (spread > 0 ? " curved" : " flat");
      const auto off = [](double angle, const dvec3& to, double by) {
        return std::cos(by) * way_at(angle) + std::sin(by) * to;
      };
      add(name + " on axis", material, spread, way_at);
      add(name + " in plane, towards", material, spread,
          [&](double a) { return off(a, -away_at(a), width); });
      add(name + " across", material, spread,
          [&](double a) { return off(a, across(), width * std::cos(a)); });
    }
  }
  // A Lambert lobe is seen at the angle of its columns.
  add("Lambert flat", kLambert, 0, way_at);
  add("Lambert curved", kLambert, 0.3, way_at);
  size_t next = 0;
  return errors_of(probe, rows, ProbeMode::vsgl, {}, [&](const exact::Surface&, const ShadingPair&) {
    const size_t i = next++;
    return exact_values[i / kViewAngles][i % kViewAngles];
  });
}

// A specular lobe of this sharpness, turned away from the surface by `tilt` rad in the plane of incidence or
// across it.
std::vector<PairRow> light_rows() {
  struct Lobe {
    const char* name;
    float sharpness;
    double in_plane, across;
  };
  std::vector<PairRow> rows;
  for (const Material& receiver : {kLambert, kPhong, kMixed}) {
    for (const double spread : {100.0, 10.0, 3.0, 1.0}) {
      for (const Lobe& lobe : {Lobe{"even", 0, 0, 0},
                               {"sharp", 50, 0, 0},
                               {"sharp, tilted in plane", 50, 0.25, 0},
                               {"sharp, tilted across", 50, 0, 0.25}}) {
        PairRow row{fmt::format("{} d/sigma {} {}", receiver.name, spread, lobe.name)};
        for (size_t k = 0; k < kViewAngles; ++k) {
          const double angle = radians(sg_receiver::kViews[k]);
          ShadingPair& pair = row.pairs[k] = mirror_pair(receiver, angle, 1 / spread);
          pair.light.specular = glm::vec3(1);
          pair.light.specular_sharpness = lobe.sharpness;
          pair.light.specular_axis = glm::vec3(glm::normalize(
              -way_at(angle) + std::tan(lobe.in_plane) * away_at(angle) + std::tan(lobe.across) * across()));
        }
        rows.push_back(row);
      }
    }
  }
  return rows;
}

std::vector<ErrorRow> gaussian_errors(ShadingProbe& probe) {
  return errors_of(
      probe, light_rows(), ProbeMode::vsgl, {}, [](const exact::Surface& s, const ShadingPair& pair) {
        return exact::reflected_radiance(s, exact::incoming_gaussian(pair.light, s.position), 1e-4).value.x;
      });
}

std::vector<ErrorRow> disk_errors(ShadingProbe& probe) {
  std::vector<PairRow> rows = light_rows();
  // The light's diffuse lobe, on its axis and off it.
  for (const auto& [name, tilt] : {std::pair("diffuse", 0.0), {"diffuse, tilted", 0.8}}) {
    for (const double spread : {100.0, 3.0, 1.0}) {
      PairRow row{fmt::format("Lambert d/sigma {} {}", spread, name)};
      for (size_t k = 0; k < kViewAngles; ++k) {
        const double angle = radians(sg_receiver::kViews[k]);
        ShadingPair& pair = row.pairs[k] = mirror_pair(kLambert, angle, 1 / spread);
        pair.light.diffuse = glm::vec3(1);
        pair.light.diffuse_sharpness = 2;
        pair.light.diffuse_axis = glm::vec3(glm::normalize(-way_at(angle) + std::tan(tilt) * across()));
      }
      rows.push_back(row);
    }
  }
  return errors_of(
      probe, rows, ProbeMode::vsgl, {{"SHADING_MODEL", "1"}},
      [](const exact::Surface& s, const ShadingPair& pair) {
        return exact::reflected_radiance(s, exact::incoming_disk(pair.light, s.position), 1e-4).value.x;
      });
}

// A light that radiates alike in all directions is an SG of sharpness d²/σ²: here as sharp as the receiver's
// lobe, on the lobe's axis and a width of the lobe off it.
std::vector<ErrorRow> even_light_errors(ShadingProbe& probe, const std::string& receiver) {
  std::vector<PairRow> rows;
  for (const float ndf : {-30.0f, -1023.0f, 0.1f, 0.3f, 1.0f}) {
    const double width = std::min(2 / std::sqrt(sharpness_of(ndf)), radians(30));
    for (const char* place : {"on axis", "in plane, towards", "across"}) {
      PairRow row{fmt::format("{} {}", ndf_name(ndf), place)};
      for (size_t k = 0; k < kViewAngles; ++k) {
        const double angle = radians(sg_receiver::kViews[k]);
        ShadingPair& pair = row.pairs[k] =
            mirror_pair({"", 0, 1, ndf}, angle, 1 / std::sqrt(sharpness_of(ndf)));
        const dvec3 off = place[0] == 'o'   ? dvec3(0)
                          : place[0] == 'i' ? -std::tan(width) * away_at(angle)
                                            : std::tan(width * std::cos(angle)) * across();
        pair.light.mean = glm::vec3(glm::normalize(way_at(angle) + off));
        pair.light.specular = glm::vec3(1);
      }
      rows.push_back(row);
    }
  }
  return errors_of(probe, rows, ProbeMode::vsgl, {{"RECEIVER_LOBE", receiver}},
                   [](const exact::Surface& s, const ShadingPair& pair) {
                     const double sigma2 = pair.light.variance;
                     const exact::Incoming sg = exact::incoming_sg(dvec3(pair.light.mean), 1 / sigma2);
                     return exact::reflected_radiance(s, sg, 1e-4).value.x / (2 * std::numbers::pi * sigma2);
                   });
}

std::vector<ErrorRow> exact_brdf_errors(ShadingProbe& probe, ProbeMode mode) {
  std::vector<PairRow> rows;
  for (const Material& receiver : {kLambert, kRough, kPhong}) {
    for (const Material& emitter : {kLambert, kRough, kPhong}) {
      for (const double radius : {1e-3, 0.03, 0.3, 1.5}) {
        PairRow row{fmt::format("{} from {} r/d {}", receiver.name, emitter.name, radius)};
        for (size_t k = 0; k < kViewAngles; ++k) {
          const double angle = radians(sg_receiver::kViews[k]);
          ShadingPair& pair = row.pairs[k] = mirror_pair(receiver, angle, radius / std::sqrt(2.0));
          set_texel(emitter, angle, &pair);
        }
        rows.push_back(row);
      }
    }
  }
  return errors_of(probe, rows, mode, {}, [&](const exact::Surface& s, const ShadingPair& pair) {
    const exact::Integral integral =
        mode == ProbeMode::filtered
            ? exact::radiance_of_disk(s, pair.texel, pair.light.variance, 1e-4)
            : exact::reflected_radiance(s, exact::incoming_disk(pair.light, pair.texel, s.position), 1e-4);
    return integral.value.x;
  });
}

}  // namespace

const std::vector<std::string>& oracle_names() {
  static const std::vector<std::string> names = {"receiver", "filtered", "isotropic", "emitter",
                                                 "gaussian", "disk",     "cancelled", "filtered_brdfs"};
  return names;
}

std::vector<ErrorRow> approximation_errors(Device& device, const std::string& oracle) {
  if (oracle == "receiver") return receiver_errors(device);
  ShadingProbe probe(device);
  if (oracle == "filtered") return even_light_errors(probe, "1");
  if (oracle == "isotropic") return even_light_errors(probe, "2");
  if (oracle == "emitter") return emitter_errors(probe);
  if (oracle == "gaussian") return gaussian_errors(probe);
  if (oracle == "disk") return disk_errors(probe);
  return exact_brdf_errors(probe, oracle == "cancelled" ? ProbeMode::cancelled : ProbeMode::filtered);
}

}  // namespace vsglbench
