// Whether a method's light sets can carry the power that they do, by what the method states of itself.
#pragma once

#include <span>
#include <string>

#include "method/method.h"

namespace vsglbench {

// `ratios`: Σ light power / Σ texel power of each seed's lights. Empty, or why they are refused, in one line.
//
// A method whose flux_bound is at most 1e-3 states that every texel is in some light: each set must keep to
// its bound, and to 1 % for sums in single precision. What draws its lights states only the mean over shifts
// of the lattice, and that cannot be held to a bound on both sides: where the PDF is uneven, a rare light
// carries most of the flux (`vpl` on ring514: seven seeds at 0.05 and one at 8), so that too little in S
// seeds shows nothing. Too much does: the ratios are independent, above 0 and of mean at most 1+b, so the
// mean of ∏ r/(1+b) is at most 1, and it exceeds 200 once in 200 sound cases at the very most (Markov's
// inequality; far more seldom where rare lights make r skew to the right, as they do). With eight seeds that
// refuses whatever carries 1.94 (1+b) times the flux in all of them, with one seed 200 (1+b) times.
std::string flux_fault(const MethodInfo& method, std::span<const double> ratios);

}  // namespace vsglbench
