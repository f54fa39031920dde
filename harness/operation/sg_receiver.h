// The receiver's specular lobe under an SG of incoming radiance: rows of `vsglbench sg --function receiver`,
// as the device's arguments and by cubature of the rendering integral with the exact BRDF.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shaders/rendering_integral.h"

namespace vsglbench::sg_receiver {

// The columns: `ndf` > 0 GGX α, < 0 minus the Phong exponent; `f0`; `view`, angle of the viewer from the
// normal, degrees; `offset`, degrees from the mirror direction to the SG's axis, along `plane`: 0 in the
// plane of incidence, away from the normal; 180 in it, towards the normal; 90 across it; `sharpness` of the
// SG.
const std::vector<std::string>& columns();

std::pair<double, double> domain(const std::string& column);
// What makes a value of this column none; empty: nothing.
std::string out_of_domain(const std::string& column, float value);

// What the device gets of a row: axis, sharpness; normal; view; f0, ndf. No coordinate plane is favoured.
inline constexpr size_t kDeviceColumns = 12;
void append_arguments(std::span<const float> row, std::vector<float>* out);

// ∫ G(ω) f(v,ω) max(n·ω,0) dω, to 1e-4 of itself.
double integral(const float* arguments);

// The view angles of the table, degrees.
inline constexpr float kViews[] = {0, 15, 30, 45, 60, 75, 85};
// Where the SG stands, in the order of the table's rows.
inline constexpr const char* kPlaces[] = {"on axis", "in plane, away", "in plane, towards", "across"};

// The table's rows: Phong 30 to 65535 and GGX 0.05 to 1, F0 1 and 0.04; on the lobe's axis, and a width of
// the lobe off it, 2/√λh in the plane of incidence (30° at most) and 2 n·v/√λh across; the SG as sharp as the
// distribution, and a sixteenth of that.
std::vector<float> table_rows();

}  // namespace vsglbench::sg_receiver
