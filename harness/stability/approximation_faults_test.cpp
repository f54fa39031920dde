// Faults planted in the shaders that the oracles of operation/approximations.h must see: a wrong axis, a
// missing cosine, a factor 2.
#include <gtest/gtest.h>

#include <algorithm>

#include "operation/approximation_table.h"
#include "stability/planted_tree.h"

using namespace vsglbench;

namespace {

Device& device() {
  static Device d;
  return d;
}

struct Fault {
  std::string oracle, kind, file, text, in_its_place;
};

// Share of the oracle's cases that differ from the table.
double share_of_cases(const std::string& oracle) {
  if (oracle == "vsl") {
    double wrong = 0;
    const auto errors = vsl_errors(device(), 128);
    for (const SampledError& e : errors) wrong += std::abs(e.error) > 6 * e.standard_error;
    return wrong / static_cast<double>(errors.size());
  }
  if (oracle == "cancelling") {
    constexpr double decisions = 4 * 2 * 3 * 7 * 2 + 1;
    return static_cast<double>(wrong_cancellations(device()).size()) / decisions;
  }
  const auto rows = approximation_errors(device(), oracle);
  return static_cast<double>(differences_from_table(oracle, rows).size()) / static_cast<double>(rows.size());
}

// What a swap of both bandwidths makes of the receiver's lobe.
const char* const kSwap =
    "r.peak = ndf_peak(s.ndf);\n  r.eta_x += r.eta_y; r.eta_y = r.eta_x - r.eta_y; r.eta_x -= r.eta_y;";
const char* const kPeak = "r.peak = ndf_peak(s.ndf);";

}  // namespace

class PlantedApproximation : public ::testing::TestWithParam<Fault> {};

TEST_P(PlantedApproximation, IsSeen) {
  const Fault& fault = GetParam();
  const PlantedTree tree;
  size_t planted = 0;
  tree.edit_shaders([&](std::string text) {
    const size_t at = text.find(fault.text);
    // edit_shaders hands over no path: a file is known by its include guard.
    if (at == std::string::npos || text.find(fault.file) == std::string::npos) return text;
    ++planted;
    return text.replace(at, fault.text.size(), fault.in_its_place);
  });
  ASSERT_EQ(planted, 1u) << fault.text;
  const double share = share_of_cases(fault.oracle);
  std::printf("%s, %s: %.0f %% of the cases differ\n", fault.oracle.c_str(), fault.kind.c_str(), 100 * share);
  EXPECT_GT(share, 0.1);
}

INSTANTIATE_TEST_SUITE_P(
    Faults, PlantedApproximation,
    ::testing::Values(
        Fault{"receiver", "wrong axis", "VSGLBENCH_RECEIVER_GLSL", kPeak, kSwap},
        Fault{"receiver", "missing cosine", "VSGLBENCH_RECEIVER_GLSL", "r.alpha) * cosine * lobe",
              "r.alpha) * lobe"},
        Fault{"receiver", "factor 2", "VSGLBENCH_RECEIVER_GLSL", kPeak, "r.peak = 2.0 * ndf_peak(s.ndf);"},
        Fault{"receiver", "squared cosine left out", "VSGLBENCH_RECEIVER_GLSL", "(8.0 * r.nv * r.nv)",
              "(8.0 * r.nv)"},
        Fault{"filtered", "wrong axis", "VSGLBENCH_RECEIVER_GLSL", "safe_normalize(sg.axis + r.surface.view",
              "safe_normalize(sg.axis + r.surface.normal"},
        Fault{"filtered", "missing cosine", "VSGLBENCH_RECEIVER_GLSL", "4.0 * vh * sg.sharpness",
              "4.0 * sg.sharpness"},
        Fault{"filtered", "factor 2", "VSGLBENCH_RECEIVER_GLSL", "4.0 * vh * sg.sharpness",
              "2.0 * vh * sg.sharpness"},
        Fault{"emitter", "wrong axis", "VSGLBENCH_FIELD_GLSL", "reflect(-s.view, s.normal)", "s.view"},
        Fault{"emitter", "missing cosine", "VSGLBENCH_FIELD_GLSL", "/ (4.0 * cosine)", "/ 4.0"},
        Fault{"emitter", "factor 2", "VSGLBENCH_FIELD_GLSL", "(4.0 * cosine)", "(2.0 * cosine)"},
        Fault{"gaussian", "wrong axis", "VSGLBENCH_VSGL_SHADING_GLSL",
              "-light.specular_axis, light.specular_sharpness, log_s",
              "light.specular_axis, light.specular_sharpness, log_s"},
        Fault{"gaussian", "missing cosine", "VSGLBENCH_VSGL_SHADING_GLSL",
              "sg_clamped_cosine(nl, sg.sharpness)", "1.0"},
        Fault{"gaussian", "factor 2", "VSGLBENCH_VSGL_SHADING_GLSL", "distance2 / variance;",
              "0.5 * distance2 / variance;"},
        Fault{"disk", "wrong axis", "VSGLBENCH_VSGL14_SHADING_GLSL", "-light.specular_axis",
              "light.specular_axis"},
        Fault{"disk", "missing cosine", "VSGLBENCH_VSGL14_SHADING_GLSL", "(nl / PI)", "(1.0 / PI)"},
        Fault{"disk", "factor 2", "VSGLBENCH_VSGL14_SHADING_GLSL", "return 2.0 / area", "return 1.0 / area"},
        Fault{"cancelled", "wrong axis", "VSGLBENCH_VPL_SHADING_GLSL",
              "brdf_cosine(vpl_surface(light), -direction, LIGHT_LOBES)",
              "brdf_cosine(vpl_surface(light), direction, LIGHT_LOBES)"},
        Fault{"cancelled", "missing cosine", "VSGLBENCH_BRDF_GLSL", "fresnel(s.f0, dot(l, h))) * nl;",
              "fresnel(s.f0, dot(l, h)));"},
        Fault{"filtered_brdfs", "wrong axis", "VSGLBENCH_FILTERED_SHADING_GLSL",
              "-dot(to_mean, light.normal)", "dot(to_mean, s.normal)"},
        Fault{"filtered_brdfs", "missing cosine", "VSGLBENCH_DISK_GLSL", "dot(flow, normal)", "magnitude"},
        Fault{"filtered_brdfs", "horizon left out", "VSGLBENCH_DISK_GLSL", "mix(uncut, sphere, share)",
              "uncut"},
        Fault{"filtered_brdfs", "emitter cosine left out", "VSGLBENCH_DISK_GLSL",
              "along * to_centre + (height * along - down) * normal",
              "to_centre / s * inversesqrt(distance2)"},
        Fault{"filtered_brdfs", "upright part left out", "VSGLBENCH_DISK_GLSL",
              "float along = 2.0 * height / ((distance2 + radius2 + s) * s);", "float along = 0.0;"},
        Fault{"filtered_brdfs", "factor 2 of the disk", "VSGLBENCH_DISK_GLSL", "4.0 * radius2 * height",
              "2.0 * radius2 * height"},
        Fault{"filtered_brdfs", "factor 2", "VSGLBENCH_FILTERED_SHADING_GLSL", "0.25 * solid_angle_over_area",
              "0.5 * solid_angle_over_area"},
        Fault{"filtered_brdfs", "half angle left out", "VSGLBENCH_FILTERED_SHADING_GLSL",
              "spread * per_length", "spread"},
        Fault{"cancelled", "factor 2", "VSGLBENCH_DISK_GLSL", "return 2.0 / (h * (h + distance))",
              "return 1.0 / (h * (h + distance))"},
        Fault{"cancelling", "wrong axis", "VSGLBENCH_VSGL_SHADING_GLSL", "max(r.eta_x, r.eta_y)", "r.eta_x"},
        Fault{"cancelling", "missing cosine", "VSGLBENCH_RECEIVER_GLSL", "(8.0 * r.nv * r.nv)",
              "(8.0 * r.nv)"},
        Fault{"cancelling", "factor 2", "VSGLBENCH_VSGL_SHADING_GLSL", "< 4.0 * alpha", "< 2.0 * alpha"},
        Fault{"vsl", "wrong axis", "VSGLBENCH_VSL_SHADING_GLSL", "brdf_pdf(emitter, -direction, LIGHT_LOBES)",
              "brdf_pdf(emitter, direction, LIGHT_LOBES)"},
        Fault{"vsl", "missing cosine", "VSGLBENCH_BRDF_GLSL", "fresnel(s.f0, dot(l, h))) * nl;",
              "fresnel(s.f0, dot(l, h)));"},
        Fault{"vsl", "factor 2", "VSGLBENCH_VSL_SHADING_GLSL", "1.0 / (2.0 * PI * c.one_minus_cosine)",
              "1.0 / (PI * c.one_minus_cosine)"}),
    [](const auto& fault) {
      std::string name = fault.param.oracle + "_" + fault.param.kind;
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    });
