// Inside the conformance kit: what one light record must keep to, and what power it carries.
#pragma once

#include <string>

#include "frame/light_records.h"

namespace vsglbench {

// What is wrong with a light, as in "has variance nan; expected a finite number > 0"; empty: nothing.
std::string fault_of(const gpu::Vsgl& light);
std::string fault_of(const gpu::Vpl& light);

// The first light at fault, as in "light 4 has variance nan; ..."; empty: none. `powerless`: no light may
// have power.
std::string first_fault(const LightRecords& lights, bool powerless);

// "light 4 differs" for the first that does; empty: equal to the bit.
std::string first_difference(const LightRecords& a, const LightRecords& b);

// Σ power as the lights state it, and as they carry it (LightSummary), W.
struct LightPower {
  double stated = 0, carried = 0;
};
LightPower sum_power(const LightRecords& lights);

}  // namespace vsglbench
