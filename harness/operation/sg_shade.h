// A whole VSGL at a whole surface: rows of `vsglbench sg --function shade`, as the device's arguments and in
// double precision.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shaders/shading_exact.h"

namespace vsglbench::sg_shade {

// What a row asks. The light's mean stands at `distance` from the surface, in a direction of this cosine with
// the normal, at `light_azimuth` from the viewer's. Its lobes' axes make these angles with the way to the
// surface: 0 shines at it, 3.1415927 away from it. Intensities are c_v, W/sr; `ndf` > 0: GGX α, < 0: minus
// the Phong exponent. `frame` 0: the normal is z; else all directions are turned so that no coordinate plane
// is favoured.
const std::vector<std::string>& columns();

// Inclusive bounds of a column; of `ndf`, from the sharpest Phong lobe to the roughest GGX.
std::pair<double, double> domain(const std::string& column);
// What makes a value of this column none, "ndf is 0, not in ..."; empty: nothing.
std::string out_of_domain(const std::string& column, float value);

// What the device gets of a row, and the oracle: mean, variance; axis and sharpness of the diffuse lobe, of
// the specular one; both intensities; normal; view; albedo, f0, ndf. The surface is at the origin.
inline constexpr size_t kDeviceColumns = 23;
void append_arguments(std::span<const float> row, std::vector<float>* out);

struct Answer {
  double value = 0;  // W/(m² sr)
  double scale = 0;  // what an error is compared with
  double floor = 0;  // an error below it counts as none
};
// The scale is |value| plus the condition of the problem: the sum of what value changes by when the direction
// to the light, an axis, the normal or the view turns by 2^-21 rad, either way about two axes, or distance,
// variance or a sharpness changes by 2^-21 of itself, over 2^-21. An error of e scales is what arguments that
// are off by e make. For all models but cosine, whose bounds are absolute, the diffuse light at L = 1 comes
// on top. The floor is 2^-124 of 1 and of the light without its exponential attenuation: below that, single
// precision underflows.
Answer answer(const float* arguments, exact::DiffuseModel model);

}  // namespace vsglbench::sg_shade
