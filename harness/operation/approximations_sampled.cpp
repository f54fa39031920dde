// The two oracles of approximations.h that are no table: the sampled estimate of virtual spherical lights,
// and the decision of bias reduction.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "operation/approximation_cases.h"
#include "operation/approximations.h"
#include "shaders/rendering_integral.h"

namespace vsglbench {

using namespace approximation;

std::vector<SampledError> vsl_errors(Device& device, uint32_t runs) {
  std::vector<SampledError> errors;
  std::vector<ShadingPair> pairs;
  for (const Material& receiver : {kLambert, kRough, kPhong}) {
    for (const Material& emitter : {kLambert, kRough}) {
      for (const double radius : {0.1, 0.9, 2.0}) {
        for (const float view : sg_receiver::kViews) {
          ShadingPair pair = mirror_pair(receiver, radians(view), radius);
          set_texel(emitter, radians(view), &pair);
          pair.texel.radius = static_cast<float>(radius);
          pair.texel.samples = 16;
          pairs.push_back(pair);
          errors.push_back(
              {fmt::format("{} from {} r/d {} at {}", receiver.name, emitter.name, radius, view)});
        }
      }
    }
  }
  const auto values = ShadingProbe(device).shade(pairs, ProbeMode::vsl, {}, 0, runs);
  for (size_t i = 0; i < pairs.size(); ++i) {
    const double count = runs;
    double mean = 0, square = 0;
    for (uint32_t r = 0; r < runs; ++r) mean += values[i * runs + r].x / count;
    for (uint32_t r = 0; r < runs; ++r) square += std::pow(values[i * runs + r].x - mean, 2);
    const double exact = exact::shade_vsl(exact::surface_of(pairs[i].surface), pairs[i].texel, 1e-4).value.x;
    errors[i].error = mean / exact - 1;
    errors[i].standard_error = std::sqrt(square / (count * (count - 1))) / exact;
  }
  return errors;
}

std::vector<std::string> wrong_cancellations(Device& device) {
  ShadingProbe probe(device);
  std::vector<std::string> wrong;
  for (const float ndf : {-30.0f, -300.0f, -1023.0f, -65535.0f}) {
    for (const float emitter : {0.0f, 40.0f}) {
      for (const double radius : {1e-3, 0.1, 2.0}) {
        for (const float view : sg_receiver::kViews) {
          ShadingPair pair = mirror_pair({"", 0.5f, 1, ndf}, radians(view), radius / std::sqrt(2.0));
          pair.light.diffuse = glm::vec3(1);
          pair.light.diffuse_sharpness = 2;
          pair.light.specular = glm::vec3(emitter > 0 ? 1 : 0);
          pair.light.specular_sharpness = emitter;
          const auto [in_plane, across] = exact::reflected_bandwidths(exact::surface_of(pair.surface));
          const double sharpest = 2 * std::max(in_plane, across) + emitter;
          const double solid_angle = 2 * std::numbers::pi * (1 - 1 / std::sqrt(1 + radius * radius));
          const double alpha = sharpest * solid_angle / (4 * std::numbers::pi);
          for (const auto& [factor, cancels] : {std::pair(0.99, 0.0f), {1.01, 1.0f}}) {
            const auto value =
                probe.shade({pair}, ProbeMode::cancelled, {}, static_cast<float>(factor * alpha))[0];
            if (value.a != cancels)
              wrong.push_back(fmt::format("Phong {} at {}, emitter {}, r/d {}: {} at {} of the bound", -ndf,
                                          view, emitter, radius, value.a, factor));
          }
        }
      }
    }
  }
  ShadingPair diffuse = mirror_pair(kLambert, radians(60), 3);
  diffuse.light.diffuse = glm::vec3(1);
  diffuse.light.diffuse_sharpness = 2;
  if (probe.shade({diffuse}, ProbeMode::cancelled, {}, 1e-6f)[0].a != 1)
    wrong.push_back("a diffuse pair is kept");
  return wrong;
}

}  // namespace vsglbench
